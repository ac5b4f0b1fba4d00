#include "core/simulation/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/body/stress.h"
#include "core/error.h"
#include "core/files.h"
#include "core/simulation/drivers.h"
#include "core/simulation/part_measures.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/skin_supports.h"

namespace sprung {
namespace {

template <class Pinned>
bool is_pin_of(const Pinned& pinned, const SceneBody& body, const std::string& name) {
  return body.pins[pinned.pin].name == name;
}

}  // namespace

Recorder::Recorder(const Scene& scene, const Simulation& simulation, std::string progress_name, RunCache* cache)
    : scene_(scene), simulation_(simulation), cache_(cache) {
  recording_.progress_name = std::move(progress_name);
  for (const Probe& probe : scene.probes) {
    recording_.probes.push_back({.name = probe.name, .kind = probe.kind(), .samples = {}});
    seats_.push_back(probe.point ? seat_of(probe) : PointSeat{});
    if (probe.kind() == ProbeKind::kPart) check_part(recording_.probes.size() - 1);
  }
}

Recorder::PointSeat Recorder::seat_of(const Probe& probe) const {
  for (std::size_t row = 0; row < simulation_.world.bodies.size(); ++row) {
    const Origin& origin = simulation_.origins[row];
    if (origin.body != std::size_t(probe.body - 1)) continue;
    const Body& body = simulation_.world.bodies[row];
    PointSeat seat{.body = row, .embedding = embed(body.grid, (origin.bricks_from_rest * *probe.point).transpose())};
    if (seat.embedding.outside > 0) continue;
    seat.start = deform_points(body.grid, seat.embedding, body.rest_positions).row(0);
    return seat;
  }
  throw Error(ErrorKind::kBadInput,
              fmt::format("probe '{}': its point ({:.6g}, {:.6g}, {:.6g}) m is in no brick of body {}; points are "
                          "measured from the middle of the body's bounding box",
                          probe.name, probe.point->x(), probe.point->y(), probe.point->z(), probe.body));
}

void Recorder::check_part(std::size_t probe) const {
  for (const Origin& origin : simulation_.origins) {
    for (const ProbedPart& part : origin.probed) {
      if (part.probe == probe) return;
    }
  }
  throw Error(ErrorKind::kBadInput,
              fmt::format("probe '{}': its part reaches no brick of body {}; boxes and balls go from 0 to 1 over the "
                          "body's bounding box",
                          scene_.probes[probe].name, scene_.probes[probe].body));
}

int Recorder::resume_from_cache(World& world, const std::function<void(IntegratorState&)>& serialize) {
  if (cache_ == nullptr) return 0;
  IntegratorState empty;
  serialize(empty);
  const int count = cache_->begin(scene_, simulation_, recording_.progress_name, empty.row().size());
  for (int i = 0; i < count; ++i) {
    const CachedFrame frame = cache_->frame(i);
    recording_.progress.push_back(frame.progress);
    recording_.seconds.push_back(frame.seconds);
    for (std::size_t probe = 0; probe < recording_.probes.size(); ++probe) {
      recording_.probes[probe].samples.push_back(sample_of(frame, probe));
    }
  }
  if (count == 0) return 0;
  IntegratorState state = cache_->restore(world);
  serialize(state);
  frame_began_ = std::chrono::steady_clock::now();
  return count;
}

void Recorder::add(double progress, const std::vector<Points>& reactions, double time, bool small,
                   const IntegratorState& state) {
  if (cache_ == nullptr) {
    std::vector<Floats3>& frame = recording_.frames.emplace_back();
    for (const SoftBody& body : simulation_.world.bodies) frame.emplace_back(body.positions.cast<float>());
  }
  recording_.progress.push_back(progress);
  const auto now = std::chrono::steady_clock::now();
  recording_.seconds.push_back(std::chrono::duration<double>(now - frame_began_).count());
  frame_began_ = now;
  for (std::size_t i = 0; i < scene_.probes.size(); ++i) {
    const Probe& probe = scene_.probes[i];
    const auto sample = [&] {
      switch (probe.kind()) {
        case ProbeKind::kPoint:
          return point_sample(seats_[i], small);
        case ProbeKind::kPin:
          return pin_sample(probe, reactions, time, small);
        case ProbeKind::kPart:
          break;
      }
      return part_sample(i, small);
    };
    recording_.probes[i].samples.push_back(sample());
  }
  if (cache_ == nullptr) return;
  const CachedFrame frame{.progress = progress,
                          .probes = numbers_of(recording_.probes),
                          .state_hash = state_hash(simulation_.world),
                          .seconds = recording_.seconds.back()};
  cache_->add(frame, state);
}

ProbeSample Recorder::point_sample(const PointSeat& seat, bool small) const {
  const Body& body = simulation_.world.bodies[seat.body];
  ProbeSample sample;
  sample.position = deform_points(body.grid, seat.embedding, body.positions).row(0);
  sample.displacement = sample.position - seat.start;
  const auto& nodes = body.grid.nodes[seat.embedding.brick[0]];
  const StressTensors at_corners = recover_stress(body, body.positions, {nodes.begin(), nodes.end()},
                                                  small ? StrainMeasure::kSmall : StrainMeasure::kFinite);
  const Eigen::Matrix<double, 6, 1> stress = at_corners.transpose() * trilinear_weights(seat.embedding.local.row(0));
  sample.stress = stress.head<3>();
  sample.shear_stress = stress.tail<3>();
  return sample;
}

ProbeSample Recorder::pin_sample(const Probe& probe, const std::vector<Points>& reactions, double time,
                                 bool small) const {
  const std::size_t row = probe.body - 1;
  const SceneBody& scene_body = scene_.bodies[row];
  ProbeSample sample;
  double count = 0;
  for (std::size_t i = 0; i < simulation_.world.bodies.size(); ++i) {
    if (simulation_.origins[i].body != row) continue;
    const SoftBody& body = simulation_.world.bodies[i];
    for (const PinnedNodes& pinned : simulation_.origins[i].pins) {
      if (!is_pin_of(pinned, scene_body, probe.pin)) continue;
      const Pin& pin = scene_body.pins[pinned.pin];
      const Vec3 centre = centre_of(pinned.centre, pin, scene_, time, small);
      for (const int node : pinned.nodes) {
        ++count;
        sample.position += body.positions.row(node).transpose();
        sample.displacement += (body.positions.row(node) - body.rest_positions.row(node)).transpose();
        if (reactions.empty()) continue;
        Vec3 force = reactions[i].row(node);
        for (int axis = 0; axis < 3; ++axis) force[axis] *= pin.axes.fixed[axis] ? 1 : 0;
        const Vec3 arm = (small ? body.rest_positions : body.positions).row(node).transpose() - centre;
        sample.force += force;
        sample.torque += arm.cross(force);
      }
    }
    const std::vector<PinnedSkin>& skins = simulation_.origins[i].pinned_skins;
    for (std::size_t k = 0; k < skins.size(); ++k) {
      if (!is_pin_of(skins[k], scene_body, probe.pin)) continue;
      const Vec3 centre = centre_of(skins[k].centre, scene_body.pins[skins[k].pin], scene_, time, small);
      const SkinReaction reaction = reaction_of(skins[k], body.foundations[k], centre, body, small);
      count += reaction.area;
      sample.position += reaction.position;
      sample.displacement += reaction.displacement;
      if (reactions.empty()) continue;
      sample.force += reaction.force;
      sample.torque += reaction.torque;
    }
  }
  if (count == 0) return sample;
  sample.position /= count;
  sample.displacement /= count;
  return sample;
}

ProbeSample Recorder::part_sample(std::size_t probe, bool small) const {
  PartMeasures measures;
  for (std::size_t row = 0; row < simulation_.origins.size(); ++row) {
    for (const ProbedPart& part : simulation_.origins[row].probed) {
      if (part.probe == probe)
        measures.add(simulation_.world.bodies[row], part, small ? StrainMeasure::kSmall : StrainMeasure::kFinite);
    }
  }
  return measures.sample();
}

Recording Recorder::finish() {
  recording_.state_hash = state_hash(simulation_.world);
  return std::move(recording_);
}

std::uint64_t state_hash(const World& world) {
  std::uint64_t hash = hash_of({});
  const auto add = [&](const Points& points) {
    hash = hash_of(std::as_bytes(std::span(points.data(), points.size())), hash);
  };
  for (const SoftBody& body : world.bodies) {
    add(body.positions);
    add(body.velocities);
  }
  return hash;
}

}  // namespace sprung
