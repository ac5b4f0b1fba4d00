#pragma once
#include <vector>

#include "core/body/body.h"
#include "core/contact/contacts.h"
#include "core/contact/countdown.h"
#include "core/contact/search/contact_surface.h"

namespace sprung {

/// Finds the contact points of a group's bodies that obstacles must support. All are checked every few steps only,
/// those near an obstacle in every step.
class ObstacleContact {
 public:
  explicit ObstacleContact(const std::vector<const ContactSurface*>& skins) : skins_(skins) {}

  /// Appends the points that would be inside an obstacle after a step of dt, the deepest one near each corner of a
  /// brick. The others are supported by it or found in the next step; one that is too deep nevertheless is appended
  /// too: two equally loaded points would alternate and both sink in. `poses`: the obstacles' current poses.
  void find(const World& world, const std::vector<Pose>& poses, double dt, const Group& group, ContactList& contacts);

 private:
  /// The last gap query of a point, in the obstacle's frame.
  struct GapQuery {
    Vec3 position = Vec3::Zero();  // m
    Gap gap{-1, Vec3::Zero()};
    /// A lower bound of the current gap: it cannot shrink by more than the point has moved.
    [[nodiscard]] double lower_bound(const Vec3& now) const { return gap.distance - (now - position).norm(); }
  };
  /// A point near an obstacle. After a query of its own, the surface is taken to be flat while the point moves by no
  /// more than a small part of a brick.
  struct NearPoint {
    const ContactPoint* point;
    GapQuery query;
    bool is_exact = false;
  };
  [[nodiscard]] static Gap gap_now(const Shape& shape, double brick_size, const Vec3& position, NearPoint& near);
  /// A brick with points near an obstacle.
  struct Near {
    std::size_t obstacle;
    std::size_t body;
    int brick;
    std::size_t first;  // of its points in points_
    std::size_t last;   // one past them
  };
  /// The motion of a brick.
  struct BrickMotion {
    BrickColumns x;     // m
    BrickColumns v;     // m/s
    double brick_size;  // m
  };
  /// The obstacle in contact.
  struct ObstacleState {
    const Obstacle& obstacle;
    const Pose& pose;
    double gravity;  // m/s^2
    double dt;       // s
  };
  /// A point that must be supported.
  struct ActiveContact {
    const ContactPoint* point = nullptr;
    double urgency = 0;  // along the normal, to satisfy its constraint, m/s; more near its corner
    double gap = 0;      // m
    Vec3 normal;
    Vec3 goal;  // m/s
  };
  [[nodiscard]] static bool is_active(const BrickMotion& motion, const ObstacleState& state, NearPoint& near,
                                      ActiveContact& active);
  void look(const World& world, const std::vector<Pose>& poses, double dt, const Group& group);
  void look_at_brick(const Shape& shape, const Pose& pose, const Body& body, std::size_t at, Near near);
  void touch_brick(const World& world, const std::vector<Pose>& poses, double dt, const Group& group, const Near& near,
                   ContactList& contacts);

  const std::vector<const ContactSurface*>& skins_;  // by body of the group
  std::vector<Near> near_;
  std::vector<NearPoint> points_;
  std::vector<std::vector<std::vector<GapQuery>>> middles_;  // by obstacle, body and index in the skin's bricks
  Countdown to_look_;
};

}  // namespace sprung
