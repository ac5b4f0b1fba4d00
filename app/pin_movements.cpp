#include "app/pin_movements.h"

namespace sprung {
namespace {

Vec3 way(const Movement& movement, double time, const Vec3& arm, bool small) {
  return small ? movement.small_placement(time).velocity(arm) : movement.placement(time).way(arm);
}

}  // namespace

Movement movement_of(const Pin& pin, const Scene& scene) {
  if (!pin.keyframes.empty()) return {pin.keyframes, pin.interpolation};
  const double end = time_of(scene, frame_count(scene) - 1);
  if (!(end > 0)) return {};
  return {
      {{.time = end, .translate = pin.translate.value_or(Vec3::Zero()), .rotate = pin.rotate.value_or(Vec3::Zero())}},
      Interpolation::kLinear};
}

Points pin_movements(const Scene& scene, const Production& production, std::size_t actor, double time, bool small) {
  const Origin& origin = production.origins[actor];
  const Points& start = production.world.actors[actor].body.rest_positions;
  Points moved = Points::Zero(start.rows(), 3);
  for (const PinnedNodes& pinned : origin.pins) {
    const Pin& pin = scene.bodies[origin.body].pins[pinned.pin];
    const Movement movement = movement_of(pin, scene);
    for (const int node : pinned.nodes) {
      const Vec3 moves = way(movement, time, start.row(node).transpose() - pinned.centre, small);
      for (int axis = 0; axis < 3; ++axis) {
        if (pin.axes.held[axis]) moved(node, axis) = moves[axis];
      }
    }
  }
  return moved;
}

Supports supports_of(const Actor& actor) {
  Supports supports(actor.body.node_count());
  for (const KinematicNode& held : actor.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (held.axes[axis]) supports.fix(held.node, axis);
    }
  }
  return supports;
}

}  // namespace sprung
