#pragma once
#include <array>
#include <vector>

#include "core/contact/pairs/awake_pair.h"
#include "core/contact/search/contact_front.h"

namespace sprung {

/// The points and triangles, and the edges, of two surfaces, or of one with itself, that may meet in the steps to come.
/// Those further apart sleep until the front can no longer exclude that they have come closer by more than
/// distance_until_due(), unless they carry a load. Excluded: features of one surface whose bricks share a node; of two,
/// whose bricks share one with bricks glued together; and edges one of which passes through a triangle at the other:
/// they have crossed.
class FeaturePairs : private NearLists {
 public:
  /// Bricks of the two surfaces, in that order.
  using Joints = std::vector<std::array<int, 2>>;
  /// For the bodies `bodies`; their trees, the same twice for one with itself, must outlive it. `joints`: bricks glued
  /// together.
  FeaturePairs(SurfaceTree& a, SurfaceTree& b, std::array<std::size_t, 2> bodies, double friction, Joints joints = {});
  FeaturePairs(const FeaturePairs&) = delete;
  FeaturePairs& operator=(const FeaturePairs&) = delete;

  /// Call after SurfaceTree::follow(): finds the pairs that may meet until the next call.
  void wake();
  /// Appends these with their current geometry, in a fixed order. Call after SurfaceTree::refresh(), first at the
  /// positions of wake().
  void measure(std::vector<AwakePair>& awake);

 private:
  struct Sleeper {
    FeaturePair pair;
    double wake = 0;              // m, by which its bricks may come closer before it must be checked
    Vec3 normal = Vec3::Zero();   // unit, of a plane that separated its features when last measured; 0: none
    Vec3 impulse = Vec3::Zero();  // N s
    bool is_inside = false;       // the point, in the other surface, when last measured
  };
  struct NearList {
    double first_wake = 0;  // of its sleepers
    double margin = 0;      // m, within which features are listed
    double unlisted = 0;    // m: all others are at least that far apart
    std::vector<Sleeper> sleepers{};

    void add(const FeaturePair& pair, double distance) {
      if (distance > margin) {
        unlisted = std::min(unlisted, distance);
      } else {
        sleepers.push_back({.pair = pair});
      }
    }
  };
  /// By point of a skin: the pair that is nearest to it.
  struct Nearest {
    long step = -1;
    double distance = 0;  // m
    std::size_t row = 0;  // in the list of awake pairs
    bool is_loaded = false;
  };

  /// By point of a skin: whether it is inside the other.
  struct Inside {
    long look = -1;
    bool value = false;
  };

  /// Makes what is kept by point and node: not before any are near, since most bodies of many never are.
  void make_tables();
  bool fill(const NearBricks& bricks) override;
  double budget(const NearBricks& bricks) override { return lists_[bricks.list].unlisted; }
  bool clear(int list) override;
  void clear() override { lists_.clear(); }

  [[nodiscard]] bool is_self() const { return &trees_[0].get() == &trees_[1].get(); }
  [[nodiscard]] SurfaceTree& tree(std::size_t side) { return trees_[side]; }
  /// Finds the boxes around the corners of some triangles or edges; returns the box around all.
  template <class Feature>
  [[nodiscard]] AlignedBox find_boxes(SurfaceTree& tree, const std::vector<Feature>& features, int first, int last);
  void list_points(std::size_t side, int points_of, int triangles_of, NearList& list);
  void list_edges(int edges_of, int others_of, NearList& list);
  /// The gap (m) at which contact keeps two features: so that what is drawn at them keeps off too.
  [[nodiscard]] double reach_of(const FeaturePair& pair);
  [[nodiscard]] AwakePair measure(const FeaturePair& pair);
  void measure_awake();
  /// Returns whether one of two edges passes through a triangle at the other: that of the pair's first corners if
  /// `edge` is 0, of its last if it is 2.
  [[nodiscard]] bool pierces(const AwakePair& edges, int edge);
  /// The difference of the surfaces' normals at the nearest points, of any length: opposite to the pair's normal if one
  /// feature lies inside the other's surface.
  [[nodiscard]] Vec3 facing_of(const AwakePair& pair);
  /// Unit, where the nearest points coincide: that of the triangle or of both edges, on the side to which the surfaces
  /// face.
  [[nodiscard]] Vec3 normal_of_touching(const AwakePair& pair);
  /// The outward normal of the pair's triangle, of any length.
  [[nodiscard]] Vec3 outward_normal(const AwakePair& pair);
  /// Returns whether the pair's point is behind the triangle and inside its surface. A point behind a triangle can be
  /// outside: the body may have been flattened until it is inside out there.
  [[nodiscard]] bool is_inside(const AwakePair& pair);
  /// Turns a pair around whose point is inside. A point behind the triangle and beside it cannot be supported by it,
  /// but still must not cross it.
  void orient(AwakePair& pair, bool is_inside);
  /// Returns whether the bricks of two points, `point` of the surface `side`, are connected.
  [[nodiscard]] bool are_connected(std::size_t side, int point, int other) const;
  /// Checks a pair that is due: it continues to sleep, or is woken unless it is excluded.
  void look_at(Sleeper& sleeper, double closer, double coming);
  /// Returns whether a pair that is due is kept apart until the trees are followed again by the plane that last
  /// separated it, which is cheaper to find out than to measure it.
  [[nodiscard]] bool stays_apart(Sleeper& sleeper, double closer, double coming);
  /// How far (m) its two features may approach until the trees are followed again: along the normal of a plane that
  /// separates them, and so less than any two points of their clusters may.
  [[nodiscard]] double coming_closer(const FeaturePair& pair, const Vec3& normal);
  struct Woken {
    Sleeper* sleeper;
    double coming;     // m, that the two may come closer until woken again
    bool may_support;  // before another one is chosen
  };
  /// The step in which a pair carried a load at the node nearest to the point of this one.
  [[nodiscard]] long& loaded_at(const AwakePair& pair);
  /// Returns whether a woken pair need not be checked until it is woken again, since another one supports its point or
  /// its node.
  [[nodiscard]] bool may_skip(const AwakePair& pair, const Woken& woken);
  /// Points at the edge of a triangle, or inside, are supported by the nearest triangle only.
  void choose_supports(std::vector<AwakePair>& pairs);

  std::array<std::reference_wrapper<SurfaceTree>, 2> trees_;
  std::array<std::size_t, 2> bodies_;
  double friction_;
  Joints joints_;
  double brick_;  // m, of the finer of the two
  std::vector<NearList> lists_;
  std::vector<AlignedBox> boxes_;  // see find_boxes()
  std::vector<Sleeper*> awake_;
  std::vector<Woken> woken_;
  std::vector<AwakePair> measured_;  // of those awake, if they were measured as they were woken
  bool are_measured_ = false;
  std::array<std::vector<Nearest>, 2> nearest_;  // by side of the point
  std::array<std::vector<Inside>, 2> inside_;    // likewise
  long look_ = 0;
  std::array<std::vector<long>, 2> loaded_;  // by side and node
  long step_ = 0;
  ContactFront front_;
};

}  // namespace sprung
