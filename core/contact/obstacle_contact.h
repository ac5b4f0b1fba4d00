#pragma once
#include <vector>

#include "core/body/body.h"
#include "core/contact/contacts.h"
#include "core/contact/search/contact_surface.h"

namespace sprung {

/// Finds the contact points of a group's bodies that obstacles have to hold. All are looked at every few steps only,
/// those near an obstacle then in every step.
class ObstacleContact {
 public:
  explicit ObstacleContact(const std::vector<const ContactSurface*>& skins) : skins_(skins) {}

  /// Appends the points that moving by dt would leave inside an obstacle, near each corner of a brick the one that lies
  /// deepest. Others are held by it or found in the next step; one that lies too deep in spite of that is appended too:
  /// two points that press alike would take turns and both sink in. `poses`: where the obstacles are now.
  void find(const World& world, const std::vector<Pose>& poses, double dt, const Group& group, ContactList& contacts);

 private:
  /// What was last asked about a position, in the obstacle's frame.
  struct Asked {
    Vec3 position = Vec3::Zero();  // m
    Gap gap{-1, Vec3::Zero()};
    /// No less than the gap is now: it cannot shrink by more than the place has moved.
    [[nodiscard]] double least(const Vec3& now) const { return gap.distance - (now - position).norm(); }
  };
  /// A point near an obstacle. Where it was asked for itself the surface is taken to be flat from there on while the
  /// point moves by no more than a small part of a brick.
  struct NearPoint {
    const ContactPoint* point;
    Asked asked;
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
  /// How a brick moves.
  struct BrickMotion {
    BrickColumns x;     // m
    BrickColumns v;     // m/s
    double brick_size;  // m
  };
  /// What holds it.
  struct Hold {
    const Obstacle& obstacle;
    const Pose& pose;
    double gravity;  // m/s^2
    double dt;       // s
  };
  /// A point that has to be held.
  struct ActiveContact {
    const ContactPoint* point = nullptr;
    double urgency = 0;  // along the normal, that meeting its limit takes, m/s; more where it is near its corner
    double gap = 0;      // m
    Vec3 normal;
    Vec3 goal;  // m/s
  };
  [[nodiscard]] static bool is_active(const BrickMotion& motion, const Hold& hold, NearPoint& near,
                                      ActiveContact& active);
  void look(const World& world, const std::vector<Pose>& poses, double dt, const Group& group);
  void look_at_brick(const Shape& shape, const Pose& pose, const Body& body, std::size_t at, Near near);
  void touch_brick(const World& world, const std::vector<Pose>& poses, double dt, const Group& group, const Near& near,
                   ContactList& contacts);

  const std::vector<const ContactSurface*>& skins_;  // by body of the group
  std::vector<Near> near_;
  std::vector<NearPoint> points_;
  std::vector<std::vector<std::vector<Asked>>> middles_;  // by obstacle, body and place in the skin's bricks
  int steps_to_update_ = 0;
};

}  // namespace sprung
