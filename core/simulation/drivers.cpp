#include "core/simulation/drivers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simulation/body_loads.h"

namespace sprung {
namespace {

constexpr double kMaxContraction = 0.9;  // however strong
constexpr double kLongestPiece = 0.005;  // s; steps of a changing load that are too short to be visible

/// At t = 0 a movement is the identity; a curve has its first value there.
Movement from_values(std::vector<Keyframe> keyframes, Interpolation interpolation) {
  if (keyframes.front().time > 0) {
    Keyframe start = keyframes.front();
    start.time = 0;
    keyframes.insert(keyframes.begin(), start);
  }
  return {std::move(keyframes), interpolation};
}

}  // namespace

LoadDriver::Curve::Curve(const StrengthCurve& course) {
  std::vector<Keyframe> keyframes;
  keyframes.reserve(course.keyframes.size() + 1);
  for (const Strength& one : course.keyframes)
    keyframes.push_back({.time = one.time, .translate = {one.strength, 0, 0}});
  if (keyframes.empty()) keyframes.push_back({.time = 0, .translate = {1, 0, 0}});
  movement_ = from_values(std::move(keyframes), course.interpolation);
}

LoadDriver::Curve::Curve(const std::vector<GravityKeyframe>& gravity) {
  std::vector<Keyframe> keyframes;
  keyframes.reserve(gravity.size());
  for (const GravityKeyframe& one : gravity) keyframes.push_back({.time = one.time, .translate = one.gravity});
  movement_ = from_values(std::move(keyframes), Interpolation::kLinear);
}

bool LoadDriver::Curve::changes_at(double time) const { return !movement_.rate(time).shift.isZero(0); }

void LoadDriver::Curve::add_moments(std::vector<double>& moments) const {
  for (const Keyframe& keyframe : movement_.keyframes()) moments.push_back(keyframe.time);
}

LoadDriver::LoadDriver(const Scene& scene, Simulation& simulation)
    : scene_(scene), simulation_(simulation), wholes_(forced_wholes(scene, simulation.origins)) {
  if (!scene.gravity_keyframes.empty()) gravity_.emplace_back(scene.gravity_keyframes);
  if (scene.wind) wind_.emplace_back(static_cast<const StrengthCurve&>(*scene.wind));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    BodyCurves& curves = bodies_.emplace_back();
    for (const BodyForce& force : scene.bodies[i].forces)
      curves.forces.emplace_back(static_cast<const StrengthCurve&>(force));
    for (const BodyMuscle& muscle : scene.bodies[i].muscles) {
      curves.muscles.emplace_back(static_cast<const StrengthCurve&>(muscle));
    }
  }
  for (const BodyCurves& curves : bodies_) {
    for (const Curve& curve : curves.forces) curve.add_moments(moments_);
    for (const Curve& curve : curves.muscles) curve.add_moments(moments_);
  }
  for (const Curve& curve : gravity_) curve.add_moments(moments_);
  for (const Curve& curve : wind_) curve.add_moments(moments_);
}

double LoadDriver::longest_piece(double time) const {
  const auto changes = [&](const std::vector<Curve>& curves) {
    return std::any_of(curves.begin(), curves.end(), [&](const Curve& curve) { return curve.changes_at(time); });
  };
  const bool any =
      changes(gravity_) || changes(wind_) || std::any_of(bodies_.begin(), bodies_.end(), [&](const BodyCurves& curves) {
        return changes(curves.forces) || changes(curves.muscles);
      });
  return any ? kLongestPiece : std::numeric_limits<double>::infinity();
}

void LoadDriver::aim(double begin, double end) {
  const double time = (begin + end) / 2;
  World& world = simulation_.world;
  if (!gravity_.empty()) world.gravity = gravity_[0].at(time);
  if (!wind_.empty()) {
    world.wind = {.velocity = wind_[0].strength(time) * scene_.wind->velocity,
                  .density = scene_.wind->density,
                  .drag = scene_.wind->drag};
  }
  for (std::size_t body = 0; body < world.bodies.size(); ++body) world.bodies[body].loads = loads_at(body, time);
}

Loads LoadDriver::loads_at(std::size_t row, double time) const {
  const Origin& origin = simulation_.origins[row];
  const SceneBody& body = scene_.bodies[origin.body];
  const BodyCurves& curves = bodies_[origin.body];
  Loads loads;
  for (const ForcedPart& part : origin.forces) {
    const BodyForce& force = body.forces[part.force];
    const double strength = curves.forces[part.force].strength(time);
    if (strength == 0) continue;
    add_load(force, part, wholes_[row][part.force], strength, loads);
  }
  for (const MusclePart& part : origin.muscles) {
    const double strength = curves.muscles[part.muscle].strength(time);
    if (strength == 0) continue;
    Muscle& muscle = loads.muscles.emplace_back(part.full);
    muscle.contraction = std::min(strength * muscle.contraction, kMaxContraction);
  }
  return loads;
}

namespace {

constexpr double kMoment = 1e-9;  // s, shorter than any piece of a frame

bool holds(const Pin& pin, double time) {
  return pin.from <= time + kMoment && (!pin.until || time + kMoment < *pin.until);
}

/// The placement at `end` relative to that at `begin`.
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

SceneDriver::SceneDriver(const Scene& scene, Simulation& simulation)
    : scene_(scene),
      simulation_(simulation),
      loads_(scene, simulation),
      pins_(simulation.world.bodies.size()),
      skin_pins_(pins_.size()),
      moments_(loads_.moments()) {
  loads_.aim(0, 0);
  for (std::size_t body = 0; body < pins_.size(); ++body) {
    const Origin& origin = simulation.origins[body];
    const auto motion_of = [&](const auto& pinned) {
      const Pin& pin = scene.bodies[origin.body].pins[pinned.pin];
      PinMotion motion{.source = &pin, .movement = movement_of(pin, scene)};
      add_moments(pin, motion.movement, moments_);
      return motion;
    };
    for (const PinnedNodes& pinned : origin.pins) {
      pins_[body].push_back({.motion = motion_of(pinned), .pinned = &pinned});
    }
    for (const PinnedSkin& skin : origin.pinned_skins) {
      PinMotion motion = motion_of(skin);
      std::vector<SpringSupport> springs = springs_of(skin, *motion.source, simulation.world.bodies[body]);
      skin_pins_[body].push_back({.motion = std::move(motion), .skin = &skin, .springs = std::move(springs)});
    }
  }
  for (const StageObstacle& obstacle : simulation.obstacles) {
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
  for (std::size_t i = 0; i < simulation_.obstacles.size(); ++i) {
    simulation_.world.obstacles[i] = obstacle_between(simulation_.obstacles[i], scene_.obstacles[i], begin, end);
  }
  for (std::size_t row = 0; row < pins_.size(); ++row) {
    drive_nodes(row, begin, end);
    drive_skins(row, begin, end);
  }
}

void SceneDriver::drive_nodes(std::size_t row, double begin, double end) {
  if (pins_[row].empty()) return;
  SoftBody& body = simulation_.world.bodies[row];
  std::map<int, KinematicNode> pinned;
  for (NodePin& pin : pins_[row]) {
    if (holds(*pin.motion.source, begin)) {
      carry(pin, body, begin, end, pinned);
    } else {
      pin.motion.capture.reset();
    }
  }
  body.pinned.clear();
  for (const auto& [node, entry] : pinned) body.pinned.push_back(entry);
}

void SceneDriver::drive_skins(std::size_t row, double begin, double end) {
  SoftBody& body = simulation_.world.bodies[row];
  body.foundations.resize(skin_pins_[row].size());
  for (std::size_t i = 0; i < skin_pins_[row].size(); ++i) {
    auto& [motion, skin, springs_at_rest] = skin_pins_[row][i];
    std::vector<SpringSupport>& springs = body.foundations[i];
    springs.clear();
    if (!holds(*motion.source, begin)) {
      motion.capture.reset();
      continue;
    }
    if (!motion.capture) {
      motion.capture = Capture{
          .time = begin, .centre = skin->centre, .positions = deform_points(body.grid, skin->points, body.positions)};
      if (begin > kMoment)
        motion.capture->centre = motion.capture->positions.transpose() * skin->areas / skin->areas.sum();
    }
    springs = springs_at_rest;
    const Placement first = between(motion.movement, motion.capture->time, begin);
    const Placement last = between(motion.movement, motion.capture->time, end);
    const Points rest = deform_points(body.grid, skin->points, body.rest_positions);
    for (std::size_t point = 0; point < springs.size(); ++point) {
      const Vec3 start = motion.capture->positions.row(Eigen::Index(point));
      const Vec3 arm = start - motion.capture->centre;
      springs[point].displacement = start + first.way(arm) - rest.row(Eigen::Index(point)).transpose();
      springs[point].velocity = (last.way(arm) - first.way(arm)) / (end - begin);
    }
  }
}

void SceneDriver::serialize(IntegratorState& state) {
  const auto serialize_capture = [&](PinMotion& pin, std::size_t points) {
    bool is_caught = pin.capture.has_value();
    Capture caught = pin.capture.value_or(Capture{});
    caught.positions.conservativeResize(Eigen::Index(points), 3);
    if (!is_caught) caught.positions.setZero();
    state.serialize_as_double(is_caught);
    state.serialize(caught.time);
    state.serialize(caught.centre);
    state.serialize(caught.positions);
    pin.capture = is_caught ? std::optional(caught) : std::nullopt;
  };
  for (std::vector<NodePin>& pins : pins_) {
    for (NodePin& pin : pins) serialize_capture(pin.motion, pin.pinned->nodes.size());
  }
  for (std::vector<SkinPin>& pins : skin_pins_) {
    for (SkinPin& pin : pins) serialize_capture(pin.motion, pin.skin->points.brick.size());
  }
}

void SceneDriver::carry(NodePin& pin, SoftBody& soft_body, double begin, double end,
                        std::map<int, KinematicNode>& pinned) const {
  const std::vector<int>& nodes = pin.pinned->nodes;
  std::optional<Capture>& capture = pin.motion.capture;
  Body& body = soft_body;
  if (!capture) {
    capture = Capture{.time = begin, .centre = pin.pinned->centre, .positions = body.positions(nodes, Eigen::all)};
    if (begin > kMoment) capture->centre = capture->positions.colwise().mean();
  }
  const Placement placement = between(pin.motion.movement, capture->time, end);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 start = capture->positions.row(k);
    const Vec3 goal = start + placement.way(start - capture->centre);
    const auto [place, is_new] =
        pinned.try_emplace(nodes[k], KinematicNode{.node = nodes[k], .axes = {false, false, false}});
    for (int axis = 0; axis < 3; ++axis) {
      if (!pin.motion.source->axes.fixed[axis]) continue;
      place->second.axes[axis] = true;
      place->second.velocity[axis] = (goal[axis] - body.positions(nodes[k], axis)) / (end - begin);
      body.velocities(nodes[k], axis) = place->second.velocity[axis];
    }
  }
}

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

Vec3 centre_of(const Vec3& at_rest, const Pin& pin, const Scene& scene, double time, bool small) {
  return small ? at_rest : Vec3(at_rest + movement_of(pin, scene).placement(time).shift);
}

Points pin_movements(const Scene& scene, const Simulation& simulation, std::size_t body, double time, bool small) {
  const Origin& origin = simulation.origins[body];
  const Points& start = simulation.world.bodies[body].rest_positions;
  Points moved = Points::Zero(start.rows(), 3);
  for (const PinnedNodes& pinned : origin.pins) {
    const Pin& pin = scene.bodies[origin.body].pins[pinned.pin];
    const Movement movement = movement_of(pin, scene);
    for (const int node : pinned.nodes) {
      const Vec3 moves = way(movement, time, start.row(node).transpose() - pinned.centre, small);
      for (int axis = 0; axis < 3; ++axis) {
        if (pin.axes.fixed[axis]) moved(node, axis) = moves[axis];
      }
    }
  }
  return moved;
}

Supports supports_of(const SoftBody& body) {
  Supports supports(body.node_count());
  for (const KinematicNode& pinned : body.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (pinned.axes[axis]) supports.fix(pinned.node, axis);
    }
  }
  supports.springs = body.supports_after(0);
  return supports;
}

}  // namespace sprung
