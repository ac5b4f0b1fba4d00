#include "app/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/equilibrium.h"
#include "app/interrupt.h"
#include "app/pin_movements.h"
#include "app/progress.h"
#include "app/units.h"
#include "core/error.h"
#include "core/motion/integrator.h"
#include "core/motion/statics.h"

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
  Runner(Production& production, const Scene& scene, const Console& console)
      : production_(production),
        world_(production.world),
        scene_(scene),
        console_(console),
        steps_(steps_of(world_, scene)),
        bricks_(brick_count(world_)),
        total_(bricks_ * static_cast<double>(steps_.per_frame) * (frame_count(scene) - 1)),
        progress_(console, "simulate", total_, 1e-6, "M brick-steps/s") {
    forecast(steps_, total_, console);
  }

  /// From the frame before to this one.
  void run_frame(int frame) {
    aim_pins(share_of(frame));
    for (long left = steps_.per_frame; left > 0;) {
      stop_if_interrupted();
      const long steps = std::min(left, steps_.per_chunk);
      advance(world_, scheme(), steps_.dt, steps, steps_.dt * static_cast<double>(steps_done_));
      steps_done_ += steps;
      left -= steps;
      progress_.update(bricks_ * static_cast<double>(steps_done_));
      judge_long_run();
    }
  }

  /// Of the pins' movement, done at a frame.
  [[nodiscard]] double share_of(int frame) const {
    return static_cast<double>(frame) / std::max(1, frame_count(scene_) - 1);
  }

  /// Of the pins, as the bodies stand: what accelerates a held node's own mass is left out.
  [[nodiscard]] std::vector<Points> pin_reactions() const {
    std::vector<Points> all;
    if (scene_.probes.empty()) return all;
    for (const Actor& actor : world_.actors) {
      const Points weight = actor.body.masses * world_.gravity.transpose();
      all.push_back(reactions(actor.body, supports_of(actor), weight));
    }
    return all;
  }

  void finish(int frames) {
    progress_.finish(fmt::format("{} frames, {} steps of {} a frame, {} inverted bricks at the end", frames,
                                 steps_.per_frame, readable(steps_.dt, Dimension::kTime), inverted_bricks(world_)));
  }

 private:
  /// Once, when enough is done to tell.
  void judge_long_run() {
    if (is_judged_ || progress_.seconds() < kSecondsToEstimate) return;
    is_judged_ = true;
    const double seconds = progress_.seconds_to_go();
    if (seconds > scene_.solver.time_limit) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("the simulation would take about {}, longer than --time-limit ({}); {}",
                              duration_text(seconds), duration_text(scene_.solver.time_limit), kRemedy));
    }
    if (seconds < kLongRun) return;
    console_.warn(fmt::format("the simulation needs about {} more; {}", duration_text(seconds), kRemedy));
  }

  [[nodiscard]] Scheme scheme() const {
    return scene_.solver.scheme == Solver::kVerlet ? Scheme::kVerlet : Scheme::kSymplecticEuler;
  }

  /// Gives held nodes the velocities that bring them along in a frame's time.
  void aim_pins(double share) {
    const double time = steps_.dt * static_cast<double>(steps_.per_frame);
    for (std::size_t i = 0; i < world_.actors.size(); ++i) {
      if (!has_moving_pins(scene_, production_, i)) continue;
      Actor& actor = world_.actors[i];
      const Points goal = actor.body.rest_positions + pin_movements(scene_, production_, i, share, false);
      for (HeldNode& held : actor.pinned) {
        held.velocity = (goal.row(held.node) - actor.body.positions.row(held.node)).transpose() / time;
      }
    }
  }

  Production& production_;
  World& world_;
  const Scene& scene_;
  const Console& console_;
  Steps steps_;
  double bricks_;
  double total_;
  Progress progress_;
  long steps_done_ = 0;
  bool is_judged_ = false;
};

Recording record_motion(Production& production, const Scene& scene, const Console& console) {
  const int frames = frame_count(scene);
  Recorder recorder(scene, production, "time_s");
  Runner runner(production, scene, console);
  for (int frame = 0; frame < frames; ++frame) {
    if (frame > 0) runner.run_frame(frame);
    recorder.add(frame / scene.fps, runner.pin_reactions(), runner.share_of(frame), false);
  }
  runner.finish(frames);
  return recorder.finish();
}

}  // namespace

Recording simulate(Production& production, const Scene& scene, const Console& console) {
  switch (scene.solver.scheme) {
    case Solver::kStatic:
    case Solver::kLinear:
      return record_equilibria(production, scene, console);
    case Solver::kModes:
      return record_modes(production, scene, console);
    case Solver::kEuler:
    case Solver::kVerlet:
      break;
  }
  return record_motion(production, scene, console);
}

}  // namespace sprung
