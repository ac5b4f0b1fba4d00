#include "core/simulation/run_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/files.h"

namespace sprung {
namespace {

std::string difference_of_bodies(const SoftBody& cached, const SoftBody& now) {
  if (cached.grid.cells.size() != now.grid.cells.size()) {
    return fmt::format("{} bricks in the cache, {} here", cached.grid.cells.size(), now.grid.cells.size());
  }
  if (cached.grid.cells != now.grid.cells || cached.grid.nodes != now.grid.nodes || cached.masses != now.masses ||
      cached.stiffness_scale != now.stiffness_scale || cached.rest_positions != now.rest_positions) {
    return "as many bricks, but others";
  }
  if (cached.drawn.skin.positions.rows() != now.drawn.skin.positions.rows() ||
      cached.drawn.skin.positions != now.drawn.skin.positions ||
      cached.drawn.skin.triangles != now.drawn.skin.triangles) {
    return "another skin";
  }
  return "";
}

/// The part of a simulation that is stored in a cache.
CacheHeader cache_header(const Scene& scene, const Simulation& simulation, const SceneRecord& record,
                         std::string progress_name) {
  CacheHeader header;
  header.version = SPRUNG_VERSION;
  header.build = build_of_this_program();
  header.scene = record.text;
  header.progress_name = std::move(progress_name);
  for (const Probe& probe : scene.probes) header.probes.push_back(probe.name);
  header.simulation = simulation;
  return header;
}

/// Why one run cannot resume another: the first difference, with both values; empty if there is none.
std::string difference(const CacheHeader& cached, const CacheHeader& now, const SceneRecord& record) {
  if (cached.version != now.version) {
    return fmt::format("it was made by sprung {}, this is sprung {}", cached.version, now.version);
  }
  if (cached.build != now.build) {
    return fmt::format("it was made by another build of sprung {} ({}; this one is {}), whose last digits may differ",
                       now.version, cached.build, now.build);
  }
  if (cached.position_error != now.position_error) {
    return fmt::format("its positions are kept {}, here it is {}", position_accuracy(cached), position_accuracy(now));
  }
  if (record.difference) {
    if (std::string text = record.difference(cached.scene); !text.empty()) return text;
  }
  const std::vector<SoftBody>& old_bodies = cached.simulation.world.bodies;
  const std::vector<SoftBody>& new_bodies = now.simulation.world.bodies;
  if (old_bodies.size() != new_bodies.size()) {
    return fmt::format("{} solids in the cache, {} here: the meshes have changed", old_bodies.size(),
                       new_bodies.size());
  }
  for (std::size_t i = 0; i < new_bodies.size(); ++i) {
    const std::string text = difference_of_bodies(old_bodies[i], new_bodies[i]);
    if (text.empty()) continue;
    return fmt::format("the mesh of body {} has changed: {}", now.simulation.origins[i].body + 1, text);
  }
  return "";
}

}  // namespace

std::string position_accuracy(const CacheHeader& header) {
  if (header.position_error == 0) return "to the last bit";
  return fmt::format("to within {:.6g} m", header.position_error);
}

Simulation cached_simulation(const CacheHeader& header, const Scene& scene) {
  Simulation simulation = header.simulation;
  simulation.world.gravity = scene.gravity;
  for (std::size_t row = 0; row < simulation.origins.size(); ++row) {
    if (simulation.origins[row].body >= scene.bodies.size()) {
      throw Error(ErrorKind::kBadInput, "the cache is damaged: it has a body that is not in its scene");
    }
    const SceneBody& scene_body = scene.bodies[simulation.origins[row].body];
    SoftBody& body = simulation.world.bodies[row];
    Body made = make_body(std::move(body.grid), scene_body.model, simulated_material(scene, scene_body));
    made.masses = std::move(body.masses);
    made.rest_positions = std::move(body.rest_positions);
    made.positions = std::move(body.positions);
    if (made.stiffness_scale != body.stiffness_scale) {
      made.stiffness_scale = std::move(body.stiffness_scale);
      build_tiles(made);
    }
    static_cast<Body&>(body) = std::move(made);
  }
  for (std::size_t i = 0; i < simulation.obstacles.size(); ++i) {
    const SceneObstacle& obstacle = scene.obstacles.at(i);
    StageObstacle& staged = simulation.obstacles[i];
    // There is no more contact with them: it only matters which of them is level ground.
    staged.shape = obstacle.plane ? Shape(SolidHalfSpace{}) : Shape(SolidBall{});
    staged.movement = {obstacle.keyframes, obstacle.interpolation};
    simulation.world.obstacles.push_back(obstacle_between(staged, obstacle, 0, 0));
  }
  return simulation;
}

std::vector<Floats3> cached_nodes(const CacheReader& cache, std::size_t frame) {
  std::vector<Floats3> nodes;
  for (const Points& positions : cache.positions(frame)) nodes.emplace_back(positions.cast<float>());
  return nodes;
}

Recording cached_recording(const CacheReader& cache, const Scene& scene) {
  Recording recording;
  recording.progress_name = cache.header().progress_name;
  for (const Probe& probe : scene.probes) {
    recording.probes.push_back({.name = probe.name, .kind = probe.kind(), .samples = {}});
  }
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) {
    recording.frames.push_back(cached_nodes(cache, frame));
    const CachedFrame cached = cache.frame(frame);
    recording.progress.push_back(cached.progress);
    for (std::size_t probe = 0; probe < recording.probes.size(); ++probe) {
      recording.probes[probe].samples.push_back(sample_of(cached, probe));
    }
  }
  return recording;
}

namespace {

std::vector<const Points*> addresses(const std::vector<Points>& all) {
  std::vector<const Points*> list;
  list.reserve(all.size());
  for (const Points& points : all) list.push_back(&points);
  return list;
}

}  // namespace

RunCache::RunCache(std::filesystem::path file, SceneRecord record, bool resume, double position_error)
    : file_(std::move(file)), record_(std::move(record)), position_error_(position_error) {
  if (!std::filesystem::exists(file_)) return;
  if (is_being_written(file_)) refuse_second_run(file_);
  if (resume) old_ = std::make_unique<CacheReader>(file_);
}

RunCache::~RunCache() = default;

int RunCache::begin(const Scene& scene, const Simulation& simulation, const std::string& progress_name,
                    std::size_t memory_size) {
  simulation_ = &simulation;
  memory_size_ = memory_size;
  header_ = cache_header(scene, simulation, record_, progress_name);
  header_.position_error = position_error_;
  header_.velocity_error = position_error_ * scene.fps;
  if (old_) {
    if (const std::string text = difference(old_->header(), header_, record_); !text.empty()) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("'{}' cannot be resumed: {}; --overwrite starts afresh", file_.string(), text));
    }
    const int most = sprung::frame_count(scene);
    if (int(old_->frame_count()) > most) {
      throw Error(ErrorKind::kBadInput, fmt::format("'{}' has {} frames already, more than the {} of this duration",
                                                    file_.string(), old_->frame_count(), most));
    }
  }
  if (old_) {
    open();
    copy_old_frames();
  } else if (!patience_) {
    open();
  }
  return frame_count_;
}

void RunCache::open() {
  make_folder(file_.parent_path());
  writer_ = std::make_unique<CacheWriter>(file_, header_, memory_size_);
}

/// Copied before the new file takes the name of the old one: whenever the program is killed, one of them is complete.
void RunCache::copy_old_frames() {
  const auto count = old_->frame_count();
  for (std::size_t frame = 0; frame < count; ++frame) {
    const bool is_last = frame + 1 == count;
    const std::vector<Points> positions = is_last ? old_->exact_positions(frame) : old_->positions(frame);
    const std::vector<Points> velocities = is_last ? old_->exact_velocities(frame) : old_->velocities(frame);
    writer_->append(old_->frame(frame), addresses(positions), addresses(velocities), old_->memory(frame));
  }
  frame_count_ = int(count);
  if (count > 0) writer_->publish();
}

CachedFrame RunCache::frame(int frame) const { return old_->frame(frame); }

IntegratorState RunCache::restore(World& world) const {
  const std::size_t last = frame_count_ - 1;
  const std::vector<Points> positions = old_->exact_positions(last);
  const std::vector<Points> velocities = old_->exact_velocities(last);
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    world.bodies[i].positions = positions[i];
    world.bodies[i].velocities = velocities[i];
  }
  return IntegratorState(old_->memory(last));
}

void RunCache::append(const Waiting& frame) {
  writer_->append(frame.frame, addresses(frame.positions), addresses(frame.velocities), frame.memory);
}

void RunCache::add(const CachedFrame& frame, const IntegratorState& state) {
  Waiting now{.frame = frame, .positions = {}, .velocities = {}, .memory = state.row()};
  for (const SoftBody& body : simulation_->world.bodies) {
    now.positions.push_back(body.positions);
    now.velocities.push_back(body.velocities);
  }
  ++frame_count_;
  if (writer_ != nullptr) {
    append(now);
    if (frame_count_ == 1) writer_->publish();
    return;
  }
  waiting_.push_back(std::move(now));
  if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() < *patience_) return;
  open();
  for (const Waiting& earlier : waiting_) append(earlier);
  writer_->publish();
  waiting_.clear();
}

std::vector<std::vector<Floats3>> RunCache::take_frames() {
  std::vector<std::vector<Floats3>> frames;
  for (const Waiting& waiting : waiting_) {
    std::vector<Floats3>& nodes = frames.emplace_back();
    for (const Points& positions : waiting.positions) nodes.emplace_back(positions.cast<float>());
  }
  waiting_.clear();
  if (writer_ == nullptr) return frames;
  close();
  const CacheReader reader(file_);
  for (std::size_t frame = 0; frame < reader.frame_count(); ++frame) frames.push_back(cached_nodes(reader, frame));
  return frames;
}

void RunCache::close() {
  if (writer_ != nullptr) writer_->close();
}

std::vector<double> numbers_of(const std::vector<ProbeTrack>& probes) {
  std::vector<double> numbers;
  for (const ProbeTrack& track : probes) {
    const ProbeSample& last = track.samples.back();
    for (const ProbeQuantity& quantity : kProbeQuantities) {
      const std::span<const double> of_quantity = quantity.of(last);
      numbers.insert(numbers.end(), of_quantity.begin(), of_quantity.end());
    }
  }
  return numbers;
}

ProbeSample sample_of(const CachedFrame& frame, std::size_t probe) {
  const double* numbers = frame.probes.data() + kNumbersOfProbe * probe;
  ProbeSample sample;
  for (const ProbeQuantity& quantity : kProbeQuantities) {
    std::copy_n(numbers, quantity.size(), quantity.of(sample).begin());
    numbers += quantity.size();
  }
  return sample;
}

}  // namespace sprung
