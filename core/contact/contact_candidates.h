#pragma once
#include <array>
#include <utility>
#include <vector>

#include "core/contact/broad_phase.h"
#include "core/contact/contacts.h"
#include "core/contact/search/contact_surface.h"
#include "core/contact/search/facing_lists.h"

namespace sprung {

/// A point of a skin that is watched.
struct TrackedPoint {
  std::size_t body;  // of the group
  int point;         // of its skin
  Vec3 normal;       // of the skin there, when last looked
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
};

/// A point and a triangle near it: rows of what is watched.
struct CandidatePair {
  int point;
  std::array<int, 3> corners;
};

/// Points and triangles of two skins of a group, or of one skin, that are near and face each other; within one they
/// must not be connected through a common neighbour of their bricks. Bricks are compared first, by their boxes and by
/// where their normals may point: that is sought from further away, and less often.
class ContactCandidates {
 public:
  /// Of two bodies of the group, or of one with itself.
  ContactCandidates(const std::vector<const ContactSurface*>& skins, std::size_t body, std::size_t other);

  /// Seeks the bricks whose skins are within `margin` (m) of each other. Deterministic.
  void seek(const Group& group, double margin);

  /// Of all points, and of those in bricks found so, m/s, seen from the rigid motion that is nearest to the bodies'.
  [[nodiscard]] double fastest(const Group& group) const;
  [[nodiscard]] double fastest_near(const Group& group) const;

  /// Of those of the bricks that may meet within dt (s) as they move, how fast they come closer at most, m/s.
  [[nodiscard]] double closing_speed(const Group& group, double dt) const;

  /// Finds points and triangles among those bricks. Deterministic.
  void look(const Group& group, const ContactRange& reach);

  /// Takes those of a front instead. Deterministic.
  void take(const Group& group, const std::vector<std::vector<FacingPair>>& lists);

  /// Takes down how the skin is turned at the watched points; take() has done so.
  void turn(const Group& group);

  /// Takes down where the watched points are, and how fast.
  void follow(const Group& group);

  /// Whether pairs need not face each other: where they were taken from a front.
  [[nodiscard]] bool may_look_away() const { return may_look_away_; }

  /// Whether any bricks are near each other, and how near (m) those are whose points and triangles make no pairs: at
  /// least this.
  [[nodiscard]] bool has_near_bricks() const { return !near_.empty(); }
  [[nodiscard]] double nearest_beyond() const { return nearest_beyond_; }

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
  struct Place {
    std::size_t side;
    std::size_t row;  // in the skin's bricks
    AlignedBox box;   // m, of its points and triangles
    Vec3 normal;      // the axis of its normals
    double turn;      // rad: those of two bricks may touch whose axes are further apart than their turns add up to
    double cosine;    // of the turn
    double sine;
  };

  [[nodiscard]] const ContactSurface& skin_of(const Side& side) const { return *skins_[side.body]; }
  [[nodiscard]] const ContactSurface& skin_of(const Place& place) const { return skin_of(sides_[place.side]); }
  [[nodiscard]] RigidMotion rigid_motion(const Group& group) const;
  [[nodiscard]] double fastest_of(const Group& group, std::size_t side, std::size_t row,
                                  const RigidMotion& rigid) const;
  /// The bricks of a side that are near the box, and where they are.
  void add_places(const Group& group, std::size_t side, const AlignedBox& near);
  void keep_near_places();
  void find(const Group& group, Place& place);
  [[nodiscard]] bool may_touch(const Place& a, const Place& b) const;
  void pair_up(const Group& group, const Place& place, const Place& facing, const ContactRange& reach);
  void pair_up(const Group& group, const ContactRange& reach, const Place& facing, std::size_t side, int point);
  int tracked_row(const Group& group, std::size_t side, int point);

  const std::vector<const ContactSurface*>& skins_;  // by body of the group
  std::vector<Side> sides_;                          // two, or one
  std::vector<Place> places_;                        // of bricks that are near others
  std::vector<std::pair<int, int>> near_;            // rows of places_
  double nearest_beyond_ = 0;
  bool may_look_away_ = false;
  long finds_ = 0;
  std::vector<TrackedPoint> tracked_;
  std::vector<CandidatePair> pairs_;
};

}  // namespace sprung
