#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/search/group.h"
#include "core/contact/search/rigid_motion.h"
#include "core/world/world.h"

namespace sprung {

/// With the momentum and angular momentum of all bodies.
[[nodiscard]] RigidMotion rigid_motion_of(const Group& group);

/// How much of a node's velocity counts in a touch.
struct Share {
  int body;  // of the group
  int node;
  double weight;
};

/// A point of a skin that another surface has to hold in the step to come. The sum of weight times velocity over its
/// shares has to be at least goal along the normal; friction strives for goal sideways.
struct Contact {
  std::uint64_t key;     // of the place, the same from step to step
  std::size_t first;     // of its shares
  std::size_t last;      // one past them
  Vec3 normal;           // unit, from what holds the point towards it
  Vec3 goal;             // m/s
  double friction;       // Coulomb's coefficient
  bool is_glue = false;  // reaches its goal in every direction, by pulling too
};

struct ContactList {
  std::vector<Contact> list;
  std::vector<Share> shares;

  [[nodiscard]] std::span<const Share> shares_of(const Contact& contact) const {
    return std::span(shares).subspan(contact.first, contact.last - contact.first);
  }
  void clear() {
    list.clear();
    shares.clear();
  }
  void append(const ContactList& other);
};

/// Appends the shares of a point that rides in a brick, without those that are zero.
void add_shares(const Group& group, std::size_t body, int brick, const CornerWeights& weights, ContactList& contacts);

/// What touches what near which corner of which brick; `other` counts obstacles, then bodies.
[[nodiscard]] inline std::uint64_t contact_key(std::size_t other, std::size_t body, int brick, int corner) {
  return std::uint64_t{other} << 50 | std::uint64_t{body} << 36 | std::uint64_t(brick) << 3 | std::uint64_t(corner);
}

/// What a contact may push: friction gives as much sideways as its coefficient allows for what presses.
[[nodiscard]] Vec3 within_friction_cone(const Vec3& impulse, const Vec3& normal, double friction);

/// m/s^2: without gravity too what is found inside comes out.
inline constexpr double kLeastGravity = 0.1;

/// Along the normal, relative to what holds it, that a point must have at least, m/s: it may come as near in a step as
/// touching. One found inside (gap < 0, m) comes out within about twenty steps, but no faster than a throw that would
/// just reach the surface: what starts a little too deep is lifted, not shot out. `gravity` in m/s^2, its size.
[[nodiscard]] double least_speed(double gap, double gravity, double dt);

/// How many steps what is found within `margin` (m) of a surface stays all there is: nothing comes nearer by half of
/// it, at this speed (m/s), seen from any rigid motion, with room for as much again; nor does it fall further than half
/// of it meanwhile. At most 24. `gravity` in m/s^2, its size.
[[nodiscard]] int steps_until_update(double margin, double speed, double gravity, double dt);

}  // namespace sprung
