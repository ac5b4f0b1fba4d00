#pragma once
#include <vector>

#include "core/world/contact_skin.h"
#include "core/world/touch.h"

namespace sprung {

/// Finds the contact points of a group's bodies that obstacles have to hold. All are looked at every few steps only,
/// those near an obstacle then in every step.
class ObstacleContact {
 public:
  explicit ObstacleContact(const std::vector<ContactSkin>& skins) : skins_(skins) {}

  /// Appends the points that moving by dt would leave inside an obstacle, at most one near each corner of a brick: the
  /// one that lies deepest. The others are held by it or found in the next step. `poses`: where the obstacles are now.
  void find(const World& world, const std::vector<Pose>& poses, double dt, const Group& group, Touches& touches);

 private:
  /// A brick with points near an obstacle.
  struct Near {
    std::size_t obstacle;
    std::size_t actor;
    int brick;
    std::size_t first;  // of its points in points_
    std::size_t last;   // one past them
  };
  void look(const World& world, const std::vector<Pose>& poses, double dt, const Group& group);
  void look_at_brick(const Shape& shape, const Pose& pose, const Body& body, std::size_t place, Near near);
  void touch_brick(const World& world, const std::vector<Pose>& poses, double dt, const Group& group, const Near& near,
                   Touches& touches) const;

  const std::vector<ContactSkin>& skins_;  // by actor of the group
  std::vector<Near> near_;
  std::vector<const ContactPoint*> points_;
  int steps_to_look_ = 0;
};

}  // namespace sprung
