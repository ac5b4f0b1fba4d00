#pragma once
#include <cstdint>
#include <vector>

#include "core/contact/search/group.h"
#include "core/contact/search/rigid_motion.h"
#include "core/world/world.h"

namespace sprung {

/// The rigid motion with the momentum and angular momentum of all bodies.
[[nodiscard]] RigidMotion rigid_motion_of(const Group& group);

/// The weight of a node's velocity in a contact.
struct Share {
  int body;  // of the group
  int node;
  double weight;
};

/// A point of a skin that another surface must support in the coming step. The sum of weight times velocity over its
/// shares must be at least goal along the normal; friction aims at goal tangentially.
struct Contact {
  std::uint64_t key;     // of the location, the same from step to step
  std::size_t first;     // of its shares
  std::size_t last;      // one past them
  Vec3 normal;           // unit, from the other surface towards the point
  Vec3 goal;             // m/s
  double friction;       // Coulomb's coefficient
  bool is_glue = false;  // reaches its goal in every direction, by pulling too
};

struct ContactList {
  std::vector<Contact> list;
  std::vector<Share> shares;

  void clear() {
    list.clear();
    shares.clear();
  }
  void append(const ContactList& other);
};

/// Appends the non-zero shares of a point embedded in a brick.
void add_shares(const Group& group, std::size_t body, int brick, const CornerWeights& weights, ContactList& contacts);

/// Identifies a contact: the other surface, the body, and the brick corner it is near; `other` counts obstacles, then
/// bodies.
[[nodiscard]] inline std::uint64_t contact_key(std::size_t other, std::size_t body, int brick, int corner) {
  return std::uint64_t{other} << 50 | std::uint64_t{body} << 36 | std::uint64_t(brick) << 3 | std::uint64_t(corner);
}

/// The impulse limited to Coulomb's cone: its tangential part is at most the coefficient times its normal part.
[[nodiscard]] Vec3 within_friction_cone(const Vec3& impulse, const Vec3& normal, double friction);

/// m/s^2: penetrations are resolved without gravity as well.
inline constexpr double kMinGravity = 0.1;
/// Of a contact's weights: what pinned nodes carry cannot be moved.
inline constexpr double kMinFree = 0.05;

/// The least speed of a point along the normal, relative to the other surface, m/s: in a step it may approach until it
/// touches. A point inside (gap < 0, m) is moved out within about twenty steps, but no faster than a throw that would
/// just reach the surface: what starts a little too deep is lifted, not ejected. `gravity` in m/s^2, its magnitude.
[[nodiscard]] double min_speed(double gap, double gravity, double dt);

/// The number of steps for which the candidates within `margin` (m) of a surface remain complete: nothing approaches by
/// half of it at this speed (m/s), relative to any rigid motion, with as much again to spare; nor does it fall further
/// than half of it meanwhile. At most 24. `gravity` in m/s^2, its magnitude.
[[nodiscard]] int steps_until_update(double margin, double speed, double gravity, double dt);

}  // namespace sprung
