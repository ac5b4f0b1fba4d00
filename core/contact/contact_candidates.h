#pragma once
#include <array>
#include <utility>
#include <vector>

#include "core/contact/broad_phase.h"
#include "core/contact/search/contact_surface.h"
#include "core/contact/search/rigid_motion.h"

namespace sprung {

/// A tracked point of a skin.
struct TrackedPoint {
  std::size_t body;  // of the group
  int point;         // of its skin
  Vec3 normal;       // of the skin there, when last updated
  Vec3 position = Vec3::Zero();
};

/// A point and a triangle near it, as rows of tracked points.
struct CandidatePair {
  int point;
  std::array<int, 3> corners;
};

/// The distances of points and triangles that may come into contact, m.
struct ContactRange {
  double margin;   // outside
  double deepest;  // inside: what is deeper came from the other side
};

/// Points and triangles of two skins of a group, or of one skin, that are near and face each other; within one skin,
/// their bricks must not be connected through a common neighbour. Bricks are compared first, by their boxes and the
/// ranges of their normals, with a larger margin and less often.
class ContactCandidates {
 public:
  /// For two bodies of the group, or of one with itself.
  ContactCandidates(const std::vector<const ContactSurface*>& skins, std::size_t body, std::size_t other);

  /// Finds the bricks whose skins are within `margin` (m) of each other. Deterministic.
  void seek(const Group& group, double margin);

  /// The largest speed of all points, m/s, relative to the rigid motion nearest to the bodies'.
  [[nodiscard]] double fastest(const Group& group) const;

  /// The largest approach speed of those bricks that may meet within dt (s), m/s.
  [[nodiscard]] double closing_speed(const Group& group, double dt) const;

  /// Finds points and triangles among those bricks. Deterministic.
  void look(const Group& group, const ContactRange& reach);

  /// Updates the positions of the tracked points.
  void follow(const Group& group);

  [[nodiscard]] bool has_near_bricks() const { return !near_.empty(); }

  [[nodiscard]] const TrackedPoint& tracked(int row) const { return tracked_[row]; }
  /// Grouped by the point and, for each, by the body of the triangle.
  [[nodiscard]] const std::vector<CandidatePair>& pairs() const { return pairs_; }

 private:
  /// One of the skins.
  struct Side {
    std::size_t body;
    Points positions;          // of its points, as far as they were found
    std::vector<long> finds;   // by point: the search that found it
    std::vector<int> tracked;  // by point: row in tracked_, or -1
  };
  /// A brick of a skin.
  struct BrickBounds {
    std::size_t side;
    std::size_t row;  // in the skin's bricks
    AlignedBox box;   // m, of its points and triangles
    Vec3 normal;      // the axis of its normals
    double turn;      // rad: two bricks may touch if their axes are further apart than the sum of their turns
    double cosine;    // of the turn
    double sine;
  };

  [[nodiscard]] const ContactSurface& skin_of(const Side& side) const { return *skins_[side.body]; }
  [[nodiscard]] const ContactSurface& skin_of(const BrickBounds& bounds) const { return skin_of(sides_[bounds.side]); }
  [[nodiscard]] RigidMotion rigid_motion(const Group& group) const;
  [[nodiscard]] double fastest_of(const Group& group, std::size_t side, std::size_t row,
                                  const RigidMotion& rigid) const;
  /// Adds the bricks of a side that are near the box, with their positions.
  void add_bricks(const Group& group, std::size_t side, const AlignedBox& near);
  void keep_near_bricks();
  void find(const Group& group, BrickBounds& bounds);
  [[nodiscard]] bool may_touch(const BrickBounds& a, const BrickBounds& b) const;
  void pair_up(const Group& group, const BrickBounds& bounds, const BrickBounds& facing, const ContactRange& reach);
  void pair_up(const Group& group, const ContactRange& reach, const BrickBounds& facing, std::size_t side, int point);
  int tracked_row(const Group& group, std::size_t side, int point);

  const std::vector<const ContactSurface*>& skins_;  // by body of the group
  std::vector<Side> sides_;                          // two, or one
  std::vector<BrickBounds> bounds_;                  // of bricks that are near others
  std::vector<std::pair<int, int>> near_;            // rows of bounds_
  long finds_ = 0;
  std::vector<TrackedPoint> tracked_;
  std::vector<CandidatePair> pairs_;
};

}  // namespace sprung
