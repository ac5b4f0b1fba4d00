#pragma once
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/world/contact_skin.h"
#include "core/world/near_boxes.h"
#include "core/world/touch.h"

namespace sprung {

/// A point of a skin that is watched.
struct WatchedPoint {
  std::size_t actor;  // of the group
  int point;          // of its skin
  Vec3 normal;        // of the skin there, when last looked
  Vec3 place = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
};

/// A point and a triangle near it: rows of what is watched.
struct SkinPair {
  int point;
  std::array<int, 3> corners;
};

/// How far apart points and triangles are that may come to touch, m.
struct SkinReach {
  double margin;   // outside
  double deepest;  // inside: what is deeper came from the other side
};

/// Points and triangles of different skins of a group, or of one skin, that are near and face each other; within one
/// they must not hang together through a common neighbour of their bricks. Bodies are compared first, by their boxes,
/// then bricks, by theirs and by where their normals may point: that is sought from further away, and less often.
class SkinPairs {
 public:
  /// Of `self` (an actor of the group) with itself; without one, of different actors.
  SkinPairs(const std::vector<const ContactSkin*>& skins, std::optional<std::size_t> self)
      : skins_(skins), self_(self) {}

  /// Seeks the bricks whose skins are within `margin` (m) of each other. Deterministic.
  void seek(const Group& group, double margin);

  /// Finds points and triangles among those bricks. Deterministic.
  void look(const Group& group, const SkinReach& reach);

  /// Takes down where the watched points are, and how fast.
  void follow(const Group& group);

  [[nodiscard]] const WatchedPoint& watched(int row) const { return watched_[static_cast<std::size_t>(row)]; }
  /// Ordered by the point and, for each, by the actor of the triangle.
  [[nodiscard]] const std::vector<SkinPair>& pairs() const { return pairs_; }

 private:
  /// A brick of a skin.
  struct Place {
    std::size_t actor;
    std::size_t row;  // in the skin's bricks
    AlignedBox box;   // m, of its points and triangles
    Vec3 normal;      // the axis of its normals
  };

  /// Those whose boxes are near that of another; or self.
  [[nodiscard]] std::vector<std::size_t> near_actors(const Group& group, double margin) const;
  void keep_near_places();
  /// Where the points are, and the bricks that `places_` speaks of.
  void find_places(const Group& group);
  [[nodiscard]] bool may_touch(const Group& group, const Place& a, const Place& b) const;
  void pair_up(const Group& group, const Place& place, const Place& facing, const SkinReach& reach);
  void pair_up(const Group& group, const SkinReach& reach, const Place& facing, std::size_t actor, int point);
  int watched_row(const Group& group, std::size_t actor, int point);

  const std::vector<const ContactSkin*>& skins_;  // by actor of the group
  std::optional<std::size_t> self_;
  std::vector<Place> places_;                // of bricks that are near others
  std::vector<std::pair<int, int>> near_;    // rows of places_
  std::vector<Points> positions_;            // of all points, by actor, when looking
  std::vector<std::vector<long>> found_in_;  // by actor, by point: the look that found its position
  long look_ = 0;
  std::vector<std::vector<int>> rows_;  // by actor, by point: in watched_, or -1
  std::vector<WatchedPoint> watched_;
  std::vector<SkinPair> pairs_;
};

}  // namespace sprung
