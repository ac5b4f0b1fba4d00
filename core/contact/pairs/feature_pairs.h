#pragma once
#include <array>
#include <vector>

#include "core/contact/search/contact_front.h"

namespace sprung {

/// Two features of two surfaces that are near each other: a point and a triangle, or two edges.
struct FeaturePair {
  int count;                   // of the first feature's corners: 1, a point; 2, an edge
  std::array<int, 4> corners;  // points of the skins: those of the first feature, then those of the second
  std::size_t first;           // the side that the first feature is of, 0 or 1; the second is of the other

  [[nodiscard]] std::size_t side(int corner) const { return corner < count ? first : 1 - first; }
};

/// One that may be crossed in the step to come.
struct AwakePair {
  FeaturePair pair;
  std::array<std::size_t, 2> bodies;  // by side
  Vec3 normal;                        // unit, from the second feature's nearest place to the first's
  double gap;                         // m
  Eigen::Vector4d weights;            // see FeatureDistance
};

/// The points and triangles, and the edges, of two surfaces, or of one with itself, that may cross each other in the
/// steps to come. Those that are further apart sleep for as long as the front says that they cannot have come closer by
/// 0.8 of what is between them. Left out: features of one surface whose bricks share a node, and those that have
/// crossed: a point behind its triangle, an edge inside of another.
class FeaturePairs : private NearLists {
 public:
  /// Of bodies `bodies`; their trees, the same twice for one with itself, must outlive it.
  FeaturePairs(SurfaceTree& a, SurfaceTree& b, std::array<std::size_t, 2> bodies);
  FeaturePairs(const FeaturePairs&) = delete;
  FeaturePairs& operator=(const FeaturePairs&) = delete;

  /// To be called after SurfaceTree::follow(): finds those that may cross until it is called again.
  void wake();
  /// Appends these as they are now, in a fixed order. To be called after SurfaceTree::refresh().
  void measure(std::vector<AwakePair>& awake);

 private:
  struct Sleeper {
    FeaturePair pair;
    double wake;  // m, by which its block may have come closer before it has to be looked at
  };
  struct NearList {
    std::size_t block = 0;
    double first_wake = 0;  // of its sleepers
    std::vector<Sleeper> sleepers{};
  };

  bool fill(const NearBricks& bricks) override;
  bool clear(int list) override;
  void clear() override { lists_.clear(); }

  [[nodiscard]] bool is_self() const { return &trees_[0].get() == &trees_[1].get(); }
  [[nodiscard]] SurfaceTree& tree(std::size_t side) { return trees_[side]; }
  void list_points(std::size_t side, int points_of, int triangles_of, double margin, NearList& list);
  void list_edges(int edges_of, int others_of, double margin, NearList& list);
  [[nodiscard]] AwakePair measure(const FeaturePair& pair);
  /// Whether the first feature is inside of the second.
  [[nodiscard]] bool has_crossed(const AwakePair& pair);
  [[nodiscard]] bool hangs_together(std::size_t point, std::size_t other) const;

  std::array<std::reference_wrapper<SurfaceTree>, 2> trees_;
  std::array<std::size_t, 2> bodies_;
  double brick_;  // m, of the finer of the two
  std::vector<NearList> lists_;
  std::vector<FeaturePair> awake_;
  ContactFront front_;
};

/// Of what is between two features, that they may come closer in a step, beside a floor in bricks.
inline constexpr double kFreeShare = 0.8;
inline constexpr double kLeastGap = 1e-5;

/// Bricks that are left between surfaces that rest on each other where they are guarded, so that most pairs sleep.
inline constexpr double kGuardedGap = 0.03;

}  // namespace sprung
