#pragma once
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "core/world/contact_skin.h"
#include "core/world/near_boxes.h"
#include "core/world/touch.h"

namespace sprung {

/// Finds where the skins of a group's bodies touch each other and themselves: contact points against triangles, both
/// ways. A point of a skin and a triangle are looked at where they are near, face each other, and do not hang together
/// through a common node of their bricks. Pairs are sought every few steps only, and then watched in every step.
/// Limits: edges that cross between their points are held by those points only; what lies deeper in another body than
/// 0.7 bricks is not found.
class SkinContact {
 public:
  explicit SkinContact(const std::vector<ContactSkin>& skins) : skins_(skins) {}

  /// Appends the points that moving by dt would leave inside another skin, at most one near each corner of a brick and
  /// for each body that it touches: the one that is held hardest.
  void find(const World& world, double dt, const Group& group, Touches& touches);

 private:
  /// A point of a skin that is watched.
  struct Watched {
    std::size_t actor;
    int point;
    Vec3 normal;  // of the skin there, when last looked
    Vec3 place = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
  };
  /// Rows of watched_: a point and a triangle near it.
  struct Pair {
    int point;
    std::array<int, 3> corners;
  };
  /// How a point stands to a triangle.
  struct Stance {
    const Pair* pair = nullptr;
    double gap = 0;
    double least_speed = 0;
    double pull = 0;  // along the normal, that meeting its limit takes, m/s
    Vec3 normal;
    Vec3 weights;  // of the triangle's corners at the place below the point
  };

  /// A brick of a skin.
  struct Place {
    std::size_t actor;
    std::size_t row;  // in the skin's bricks
    AlignedBox box;   // m, of its points and triangles
    Vec3 normal;      // the axis of its normals
  };

  void look(const World& world, double dt, const Group& group);
  [[nodiscard]] std::vector<std::pair<int, int>> near_bricks(const World& world, const Group& group, double margin);
  [[nodiscard]] bool may_touch(const World& world, const Group& group, const Place& a, const Place& b) const;
  void pair_up(const Group& group, const Place& place, const Place& facing, double margin);
  int watched_row(const Group& group, std::size_t actor, int point);
  /// False where the point does not stand over the triangle.
  bool stand(const Pair& pair, double depth, Stance& stance) const;
  /// Takes down where the watched points are, and how fast.
  void follow(const Group& group);
  /// The actor that a pair's triangle belongs to.
  [[nodiscard]] std::size_t other_of(const Pair& pair) const;
  /// One past the pairs of the same point and the same other actor.
  [[nodiscard]] std::size_t end_of_run(std::size_t first) const;
  /// To the nearest of the triangles that the point of these pairs stands over; without a pair where there is none.
  [[nodiscard]] Stance nearest_stance(std::size_t first, std::size_t end, double depth) const;
  void keep_hardest(const World& world, double dt, Stance stance);
  void add(const Group& group, const Stance& stance, std::uint64_t key, Touches& touches) const;
  void add_shares(const Group& group, const Watched& watched, double weight, Touches& touches) const;

  const std::vector<ContactSkin>& skins_;  // by actor of the group
  std::vector<Place> places_;              // of the boxes looked at
  std::vector<Points> positions_;          // of all points, by actor, when looking
  std::vector<std::vector<int>> rows_;     // by actor, by point: in watched_, or -1
  std::vector<Watched> watched_;
  std::map<std::uint64_t, Stance> hardest_;  // of this step, by key
  std::vector<Pair> pairs_;                  // by the point's actor, its place in the skin, the other actor
  int steps_to_look_ = 0;
};

}  // namespace sprung
