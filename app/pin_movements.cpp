#include "app/pin_movements.h"

#include <algorithm>
#include <numbers>

namespace sprung {
namespace {

Vec3 movement(const Pin& pin, const Vec3& arm, double share, bool small) {
  const Vec3 degrees = share * pin.rotate;
  const Vec3 shift = share * pin.translate;
  if (small) return (degrees * std::numbers::pi / 180).cross(arm) + shift;
  return rotation_matrix(degrees) * arm - arm + shift;
}

}  // namespace

Points pin_movements(const Scene& scene, const Production& production, std::size_t actor, double share, bool small) {
  const Origin& origin = production.origins[actor];
  const Points& start = production.world.actors[actor].body.rest_positions;
  Points moved = Points::Zero(start.rows(), 3);
  for (const PinnedNodes& pinned : origin.pins) {
    const Pin& pin = scene.bodies[origin.body].pins[pinned.pin];
    for (const int node : pinned.nodes) {
      const Vec3 way = movement(pin, start.row(node).transpose() - pinned.centre, share, small);
      for (int axis = 0; axis < 3; ++axis) {
        if (pin.axes.held[static_cast<std::size_t>(axis)]) moved(node, axis) = way[axis];
      }
    }
  }
  return moved;
}

bool has_moving_pins(const Scene& scene, const Production& production, std::size_t actor) {
  const Origin& origin = production.origins[actor];
  return std::any_of(origin.pins.begin(), origin.pins.end(), [&](const PinnedNodes& pinned) {
    const Pin& pin = scene.bodies[origin.body].pins[pinned.pin];
    return !pin.translate.isZero(0) || !pin.rotate.isZero(0);
  });
}

Supports supports_of(const Actor& actor) {
  Supports supports(actor.body.node_count());
  for (const HeldNode& held : actor.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (held.axes[static_cast<std::size_t>(axis)]) supports.fix(held.node, axis);
    }
  }
  return supports;
}

}  // namespace sprung
