#include "app/scene_driver.h"

#include <algorithm>
#include <cmath>

#include "app/pin_movements.h"

namespace sprung {
namespace {

constexpr double kMoment = 1e-9;  // s, shorter than any piece of a frame

bool holds(const Pin& pin, double time) {
  return pin.from <= time + kMoment && (!pin.until || time + kMoment < *pin.until);
}

/// What brings things from where they are at one time to where they are at another.
Placement between(const Movement& movement, double begin, double end) {
  if (movement.is_still()) return {};
  const Placement first = movement.placement(begin);
  const Placement second = movement.placement(end);
  return {.shift = second.shift - first.shift,
          .rotation = second.rotation * first.rotation.transpose(),
          .scale = second.scale / first.scale};
}

void add_moments(const Pin& pin, const Movement& movement, std::vector<double>& moments) {
  moments.push_back(pin.from);
  if (pin.until) moments.push_back(*pin.until);
  for (const Keyframe& keyframe : movement.keyframes()) moments.push_back(keyframe.time);
}

}  // namespace

SceneDriver::SceneDriver(const Scene& scene, Production& production)
    : scene_(scene),
      production_(production),
      loads_(scene, production),
      grips_(production.world.actors.size()),
      moments_(loads_.moments()) {
  loads_.aim(0, 0);
  for (std::size_t actor = 0; actor < grips_.size(); ++actor) {
    const Origin& origin = production.origins[actor];
    for (const PinnedNodes& pinned : origin.pins) {
      const Pin& pin = scene.bodies[origin.body].pins[pinned.pin];
      grips_[actor].push_back({.pin = &pin, .pinned = &pinned, .movement = movement_of(pin, scene)});
      add_moments(pin, grips_[actor].back().movement, moments_);
    }
  }
  for (const StageObstacle& obstacle : production.obstacles) {
    for (const Keyframe& keyframe : obstacle.movement.keyframes()) moments_.push_back(keyframe.time);
  }
  std::sort(moments_.begin(), moments_.end());
}

std::vector<double> SceneDriver::pieces(double begin, double end) const {
  std::vector<double> ends;
  double last = begin;
  const auto add = [&](double moment) {
    const double parts = std::max(1.0, std::ceil((moment - last) / loads_.longest_piece((last + moment) / 2)));
    for (double part = 1; part < parts; ++part) ends.push_back(last + part / parts * (moment - last));
    ends.push_back(moment);
    last = moment;
  };
  for (const double moment : moments_) {
    if (moment > last + kMoment && moment < end - kMoment) add(moment);
  }
  add(end);
  return ends;
}

void SceneDriver::aim(double begin, double end) {
  loads_.aim(begin, end);
  for (std::size_t i = 0; i < production_.obstacles.size(); ++i) {
    production_.world.obstacles[i] = obstacle_between(production_.obstacles[i], scene_.obstacles[i], begin, end);
  }
  for (std::size_t i = 0; i < grips_.size(); ++i) {
    if (grips_[i].empty()) continue;
    Actor& actor = production_.world.actors[i];
    std::map<int, KinematicNode> held;
    for (FrictionPotential& grip : grips_[i]) {
      if (holds(*grip.pin, begin)) {
        carry(grip, actor, begin, end, held);
      } else {
        grip.caught.reset();
      }
    }
    actor.pinned.clear();
    for (const auto& [node, entry] : held) actor.pinned.push_back(entry);
  }
}

void SceneDriver::serialize(IntegratorState& state) {
  for (std::vector<FrictionPotential>& grips : grips_) {
    for (FrictionPotential& grip : grips) {
      bool is_caught = grip.caught.has_value();
      Catch caught = grip.caught.value_or(Catch{});
      caught.positions.conservativeResize(grip.pinned->nodes.size(), 3);
      if (!is_caught) caught.positions.setZero();
      state.serialize_as_double(is_caught);
      state.serialize(caught.time);
      state.serialize(caught.centre);
      state.serialize(caught.positions);
      grip.caught = is_caught ? std::optional(caught) : std::nullopt;
    }
  }
}

void SceneDriver::carry(FrictionPotential& grip, Actor& actor, double begin, double end,
                        std::map<int, KinematicNode>& held) const {
  const std::vector<int>& nodes = grip.pinned->nodes;
  Body& body = actor.body;
  if (!grip.caught) {
    grip.caught = Catch{.time = begin, .centre = grip.pinned->centre, .positions = body.positions(nodes, Eigen::all)};
    if (begin > kMoment) grip.caught->centre = grip.caught->positions.colwise().mean();
  }
  const Placement placement = between(grip.movement, grip.caught->time, end);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 start = grip.caught->positions.row(k);
    const Vec3 goal = start + placement.way(start - grip.caught->centre);
    const auto [place, is_new] =
        held.try_emplace(nodes[k], KinematicNode{.node = nodes[k], .axes = {false, false, false}});
    for (int axis = 0; axis < 3; ++axis) {
      if (!grip.pin->axes.held[axis]) continue;
      place->second.axes[axis] = true;
      place->second.velocity[axis] = (goal[axis] - body.positions(nodes[k], axis)) / (end - begin);
      body.velocities(nodes[k], axis) = place->second.velocity[axis];
    }
  }
}

}  // namespace sprung
