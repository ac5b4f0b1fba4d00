#include "app/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/interrupt.h"
#include "app/progress.h"
#include "app/units.h"

namespace sprung {
namespace {

constexpr double kChunkBrickSteps = 2e6;  // between two looks at Ctrl-C and the clock
constexpr double kManySteps = 20000;      // a frame, from which on a warning is due
constexpr double kLongRun = 3600;         // s to go, from which on a warning is due
constexpr double kSecondsToEstimate = 3;

constexpr std::string_view kRemedy = "fewer bricks, a softer material or a shorter --duration make it quicker";

double brick_count(const World& world) {
  double count = 0;
  for (const Actor& actor : world.actors) count += actor.body.grid.brick_count();
  return count;
}

std::vector<Floats3> node_positions(const World& world) {
  std::vector<Floats3> positions;
  for (const Actor& actor : world.actors) positions.emplace_back(actor.body.positions.cast<float>());
  return positions;
}

int inverted_bricks(const World& world) {
  int count = 0;
  for (const Actor& actor : world.actors) count += inverted_bricks(actor.body);
  return count;
}

/// The steps of one frame are of equal length and fill it exactly.
struct Steps {
  long per_frame = 1;
  double dt = 0;       // s
  long per_chunk = 1;  // depends on the scene only, so that the same scene is always cut in the same way
};

Steps steps_of(const World& world, const Scene& scene) {
  const double frame = 1 / scene.fps;
  Steps steps;
  steps.per_frame = std::max(1L, static_cast<long>(std::ceil(frame / stable_step(world))));
  steps.dt = frame / static_cast<double>(steps.per_frame);
  steps.per_chunk = std::clamp(static_cast<long>(kChunkBrickSteps / brick_count(world)), 1L, steps.per_frame);
  return steps;
}

void forecast(const Steps& steps, double brick_steps, const Console& console) {
  console.detail(fmt::format("step {}, {} steps a frame, {:.3g} brick-steps in all",
                             readable(steps.dt, Dimension::kTime), steps.per_frame, brick_steps));
  if (static_cast<double>(steps.per_frame) < kManySteps) return;
  console.warn(fmt::format("the material is so stiff for its bricks that a frame takes {} steps of {}; {}",
                           steps.per_frame, readable(steps.dt, Dimension::kTime), kRemedy));
}

/// One frame of motion in chunks.
class Runner {
 public:
  Runner(World& world, const Scene& scene, const Console& console)
      : world_(world),
        scheme_(scene.scheme),
        console_(console),
        steps_(steps_of(world, scene)),
        bricks_(brick_count(world)),
        total_(bricks_ * static_cast<double>(steps_.per_frame) * (frame_count(scene) - 1)),
        progress_(console, "simulate", total_, 1e-6, "M brick-steps/s") {
    forecast(steps_, total_, console);
  }

  void run_frame() {
    for (long left = steps_.per_frame; left > 0;) {
      stop_if_interrupted();
      const long steps = std::min(left, steps_.per_chunk);
      advance(world_, scheme_, steps_.dt, steps, steps_.dt * static_cast<double>(steps_done_));
      steps_done_ += steps;
      left -= steps;
      progress_.update(bricks_ * static_cast<double>(steps_done_));
      warn_of_long_run();
    }
  }

  void finish(int frames) {
    progress_.finish(fmt::format("{} frames, {} steps of {} a frame, {} inverted bricks at the end", frames,
                                 steps_.per_frame, readable(steps_.dt, Dimension::kTime), inverted_bricks(world_)));
  }

 private:
  void warn_of_long_run() {
    if (is_warned_ || progress_.seconds() < kSecondsToEstimate) return;
    is_warned_ = true;
    if (progress_.seconds_to_go() < kLongRun) return;
    console_.warn(
        fmt::format("the simulation needs about {} more; {}", duration_text(progress_.seconds_to_go()), kRemedy));
  }

  World& world_;
  Scheme scheme_;
  const Console& console_;
  Steps steps_;
  double bricks_;
  double total_;
  Progress progress_;
  long steps_done_ = 0;
  bool is_warned_ = false;
};

}  // namespace

Recording simulate(World& world, const Scene& scene, const Console& console) {
  const int frames = frame_count(scene);
  Recording recording;
  recording.frames.reserve(static_cast<std::size_t>(frames));
  Runner runner(world, scene, console);
  recording.frames.push_back(node_positions(world));
  for (int frame = 1; frame < frames; ++frame) {
    runner.run_frame();
    recording.frames.push_back(node_positions(world));
  }
  runner.finish(frames);
  return recording;
}

}  // namespace sprung
