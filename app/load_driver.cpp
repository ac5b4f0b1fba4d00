#include "app/load_driver.h"

#include <algorithm>
#include <limits>

namespace sprung {
namespace {

constexpr double kMostContraction = 0.9;  // however strong
constexpr double kLongestPiece = 0.005;   // s; a change over a frame comes in steps that nobody sees

/// At t = 0 a movement is where a thing is put; a curve has its first value there.
Movement from_values(std::vector<Keyframe> keyframes, Interpolation interpolation) {
  if (keyframes.front().time > 0) {
    Keyframe start = keyframes.front();
    start.time = 0;
    keyframes.insert(keyframes.begin(), start);
  }
  return {std::move(keyframes), interpolation};
}

/// Of the bricks that each force of a body acts on, in all its solids, m^3.
std::vector<double> forced_volumes(const Scene& scene, const Production& production, std::size_t body) {
  std::vector<double> volumes(scene.bodies[body].forces.size());
  for (const Origin& origin : production.origins) {
    if (origin.body != body) continue;
    for (const ForcedPart& part : origin.forces) volumes[part.force] += part.volumes.sum();
  }
  for (double& volume : volumes) volume /= copy_count(scene.bodies[body]);
  return volumes;
}

/// N, per node.
Points forces_of(const BodyForce& force, const ForcedPart& part, double volume) {
  const Vec3 per_volume = force.per_volume ? *force.per_volume : Vec3(force.total.value() / volume);
  return part.volumes * per_volume.transpose();
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

LoadDriver::LoadDriver(const Scene& scene, Production& production) : scene_(scene), production_(production) {
  if (!scene.gravity_keyframes.empty()) gravity_.emplace_back(scene.gravity_keyframes);
  if (scene.wind) wind_.emplace_back(static_cast<const StrengthCurve&>(*scene.wind));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    BodyCurves& curves = bodies_.emplace_back();
    for (const BodyForce& force : scene.bodies[i].forces)
      curves.forces.emplace_back(static_cast<const StrengthCurve&>(force));
    for (const BodyMuscle& muscle : scene.bodies[i].muscles) {
      curves.muscles.emplace_back(static_cast<const StrengthCurve&>(muscle));
    }
    curves.volumes = forced_volumes(scene, production, i);
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
  World& world = production_.world;
  if (!gravity_.empty()) world.gravity = gravity_[0].at(time);
  if (!wind_.empty()) {
    world.wind = {.velocity = wind_[0].strength(time) * scene_.wind->velocity,
                  .density = scene_.wind->density,
                  .drag = scene_.wind->drag};
  }
  for (std::size_t actor = 0; actor < world.actors.size(); ++actor) world.actors[actor].loads = loads_at(actor, time);
}

Loads LoadDriver::loads_at(std::size_t actor, double time) const {
  const Origin& origin = production_.origins[actor];
  const SceneBody& body = scene_.bodies[origin.body];
  const BodyCurves& curves = bodies_[origin.body];
  Loads loads;
  for (const ForcedPart& part : origin.forces) {
    const BodyForce& force = body.forces[part.force];
    const double strength = curves.forces[part.force].strength(time);
    if (strength == 0) continue;
    if (force.pressure) {
      loads.pressures.push_back({.triangles = part.triangles, .pressure = strength * *force.pressure});
      continue;
    }
    if (loads.forces.rows() == 0) loads.forces = Points::Zero(part.volumes.size(), 3);
    loads.forces += strength * forces_of(force, part, curves.volumes[part.force]);
  }
  for (const MusclePart& part : origin.muscles) {
    const double strength = curves.muscles[part.muscle].strength(time);
    if (strength == 0) continue;
    Muscle& muscle = loads.muscles.emplace_back(part.full);
    muscle.contraction = std::min(strength * muscle.contraction, kMostContraction);
  }
  return loads;
}

Points steady_forces(const Scene& scene, const Production& production, std::size_t actor) {
  const Origin& origin = production.origins[actor];
  const std::vector<double> volumes = forced_volumes(scene, production, origin.body);
  Points forces = Points::Zero(production.world.actors[actor].body.node_count(), 3);
  for (const ForcedPart& part : origin.forces) {
    forces += forces_of(scene.bodies[origin.body].forces[part.force], part, volumes[part.force]);
  }
  return forces;
}

}  // namespace sprung
