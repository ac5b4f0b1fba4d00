#include "app/cache/run_cache.h"

#include <fmt/format.h>

#include "app/cache/cache_header.h"
#include "core/error.h"

namespace sprung {
namespace {

std::vector<const Points*> addresses(const std::vector<Points>& all) {
  std::vector<const Points*> list;
  list.reserve(all.size());
  for (const Points& points : all) list.push_back(&points);
  return list;
}

}  // namespace

RunCache::RunCache(std::filesystem::path file, bool resume, double position_error)
    : file_(std::move(file)), position_error_(position_error) {
  if (!std::filesystem::exists(file_)) return;
  if (is_being_written(file_)) refuse_second_run(file_);
  if (resume) old_ = std::make_unique<CacheReader>(file_);
}

RunCache::~RunCache() = default;

int RunCache::begin(const Scene& scene, const Production& production, const std::string& progress_name,
                    std::size_t memory_size) {
  production_ = &production;
  CacheHeader header = cache_header(scene, production, progress_name);
  header.position_error = position_error_;
  header.velocity_error = position_error_ * scene.fps;
  if (old_) {
    if (const std::string text = difference(old_->header(), header); !text.empty()) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("'{}' cannot go on: {}; --overwrite begins anew", file_.string(), text));
    }
    const int most = sprung::frame_count(scene);
    if (int(old_->frame_count()) > most) {
      throw Error(ErrorKind::kBadInput, fmt::format("'{}' has {} frames already, more than the {} of this duration",
                                                    file_.string(), old_->frame_count(), most));
    }
  }
  writer_ = std::make_unique<CacheWriter>(file_, header, memory_size);
  if (old_) copy_old_frames();
  return frame_count_;
}

/// Into the new file, which takes the name of the old one only then: killed at any moment, one of them is whole.
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
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    world.actors[i].body.positions = positions[i];
    world.actors[i].body.velocities = velocities[i];
  }
  return IntegratorState(old_->memory(last));
}

void RunCache::add(const CachedFrame& frame, const IntegratorState& state) {
  std::vector<const Points*> positions;
  std::vector<const Points*> velocities;
  for (const Actor& actor : production_->world.actors) {
    positions.push_back(&actor.body.positions);
    velocities.push_back(&actor.body.velocities);
  }
  writer_->append(frame, positions, velocities, state.row());
  if (frame_count_++ == 0) writer_->publish();
}

void RunCache::close() { writer_->close(); }

std::vector<double> numbers_of(const std::vector<ProbeTrack>& probes) {
  std::vector<double> numbers;
  for (const ProbeTrack& track : probes) {
    const ProbeSample& last = track.samples.back();
    for (const Vec3* vector : {&last.position, &last.displacement, &last.force, &last.torque}) {
      numbers.insert(numbers.end(), vector->begin(), vector->end());
    }
  }
  return numbers;
}

ProbeSample sample_of(const CachedFrame& frame, std::size_t probe) {
  const double* numbers = frame.probes.data() + kNumbersOfProbe * probe;
  ProbeSample sample;
  for (Vec3* vector : {&sample.position, &sample.displacement, &sample.force, &sample.torque}) {
    *vector = Eigen::Map<const Vec3>(numbers);
    numbers += 3;
  }
  return sample;
}

}  // namespace sprung
