#include "core/simulation/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/contact/penetration.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/simulation/drivers.h"
#include "core/simulation/equilibria.h"
#include "core/simulation/observer.h"
#include "core/simulation/time_steps.h"
#include "core/text.h"
#include "core/units.h"
#include "core/world/load_forces.h"

namespace sprung {
namespace {

constexpr double kLongRun = 3600;  // s to go, from which on a warning is due
constexpr double kSecondsToEstimate = 3;
constexpr double kRounding = 1e-6;   // of a step, that a piece of a frame may be longer than whole steps
constexpr double kDeepShare = 0.01;  // of the largest body's size, that skins may be in each other without a warning

int inverted_bricks(const World& world) {
  int count = 0;
  for (const Actor& actor : world.actors) count += inverted_bricks(actor.body);
  return count;
}

/// How deep the contact points of skins were in each other and in obstacles at the ends of frames.
class OverlapWatch {
 public:
  void look(const World& world, int frame) {
    const double depth = deepest_penetration(world);
    if (depth <= deepest_) return;
    deepest_ = depth;
    frame_ = frame;
  }
  [[nodiscard]] double deepest() const { return deepest_; }
  [[nodiscard]] std::string summary() const {
    return deepest_ > 0 ? fmt::format("points of contact at most {} deep in what they touch",
                                      readable(deepest_, Dimension::kLength))
                        : "no point of contact in what it touches";
  }

  void warn(double size, const Observer& observer) const {
    if (deepest_ <= kDeepShare * size) return;
    observer.warn(
        fmt::format("in frame {} skins are {} deep in each other or in an obstacle, {:.1f} % of the largest "
                    "body: smaller bricks (bricks) or slower meetings keep them apart",
                    frame_ + 1, readable(deepest_, Dimension::kLength), 100 * deepest_ / size));
  }

 private:
  double deepest_ = 0;  // m
  int frame_ = 0;
};

void forecast(const StepPlan& plan, double brick_steps, const Observer& observer) {
  if (!plan.reason.empty()) observer.note("integrator " + plan.reason);
  const Steps& steps = plan.steps;
  observer.detail(fmt::format("step {}, {} steps a frame, {:.3g} brick-steps in all",
                              readable(steps.dt, Dimension::kTime), steps.count, brick_steps));
  if (const std::string warning = warning_of(plan); !warning.empty()) observer.warn(warning);
}

/// One frame of motion in chunks.
class Runner {
 public:
  /// With `whole_frames` an interrupt has to wait for the end of a frame.
  Runner(Production& production, const Scene& scene, const Observer& observer, bool whole_frames)
      : world_(production.world),
        scene_(scene),
        observer_(observer),
        whole_frames_(whole_frames),
        size_(production.size),
        driver_(scene, production),
        plan_(plan_steps(world_, scene)),
        total_(plan_.brick_steps * (frame_count(scene) - 1)),
        motion_(world_, plan_.scheme == Solver::kVerlet ? Scheme::kVerlet : Scheme::kSymplecticEuler) {
    forecast(plan_, total_, observer);
    if (!plan_.is_implicit()) return;
    implicit_.emplace(world_, ImplicitOptions{.scheme = plan_.scheme == Solver::kBdf2 ? ImplicitScheme::kBdf2
                                                                                      : ImplicitScheme::kEuler});
  }

  /// The first frame to come: those before are there already.
  void begin_at(int frame) {
    before_ = frame == 0 ? 0 : plan_.brick_steps * (frame - 1);
    progress_.emplace(observer_, "simulate", total_ - before_, 1e-6, "M brick-steps/s");
  }

  /// What the next frame depends on beside positions and velocities.
  void serialize(IntegratorState& state) {
    motion_.serialize(state);
    if (implicit_) implicit_->serialize(state);
    driver_.serialize(state);
  }
  /// How deep skins were in what they touch, m.
  [[nodiscard]] double deepest() const { return overlaps_.deepest(); }
  [[nodiscard]] IntegratorState state() {
    IntegratorState state;
    serialize(state);
    return state;
  }

  /// From the frame before to this one.
  void run_frame(int frame) {
    double begin = time_of(scene_, frame - 1);
    const std::vector<double> ends = driver_.pieces(begin, time_of(scene_, frame));
    for (const double end : ends) {
      driver_.aim(begin, end);
      run_piece(begin, ends.size() == 1 ? 1 / scene_.fps : end - begin);  // whole frames are equal to the last bit
      begin = end;
    }
    overlaps_.look(world_, frame);
  }

  /// Of the pins, as the bodies stand: what accelerates a held node's own mass is left out.
  [[nodiscard]] std::vector<Points> pin_reactions() const {
    std::vector<Points> all;
    if (scene_.probes.empty()) return all;
    for (const Actor& actor : world_.actors) {
      Points loads = actor.body.masses * world_.gravity.transpose();
      if (LoadForces acting(actor, world_); acting.any()) loads += acting.forces();
      all.push_back(reactions(actor.body, supports_of(actor), loads));
    }
    return all;
  }

  /// Of the frames of this run, which begins with `first`.
  void finish(int first, int frames) {
    note_implicit();
    const int inverted = inverted_bricks(world_);
    const bool has_more = !implicit_ && world_.actors.size() > 1;  // bodies, each with its own steps
    progress_->finish(fmt::format(
        "{}{}, {}{} steps of {} a frame, {} inverted bricks at the end, {}", count_of(frames, "frame"),
        first > 0 ? fmt::format(", {} of them in this run", frames - first) : "", has_more ? "at most " : "",
        plan_.steps.count, readable(plan_.steps.dt, Dimension::kTime), inverted, overlaps_.summary()));
    warn_of_crushed_bodies(world_, observer_);
    overlaps_.warn(size_, observer_);
  }

 private:
  void run_piece(double begin, double duration) {
    const auto between = [&](double share) {
      if (!whole_frames_) observer_.check_interrupt();
      progress_->update(total_ * (begin + share * duration) / time_of(scene_, frame_count(scene_) - 1) - before_);
      judge_long_run();
    };
    if (implicit_) {
      const long count = std::max(1L, std::lround(std::ceil(duration / plan_.steps.dt - kRounding)));
      const double dt = duration / double(count);
      for (long step = 0; step < count; ++step) {
        implicit_->advance(dt, 1, begin + dt * double(step));
        between(double(step + 1) / double(count));
      }
      return;
    }
    const std::vector<GroupSteps> groups =
        motion_.advance_frame(begin, duration, between, [&](const std::string& message) { observer_.warn(message); });
    const auto fewer = [](const GroupSteps& a, const GroupSteps& b) { return a.steps.count < b.steps.count; };
    plan_.steps = std::max_element(groups.begin(), groups.end(), fewer)->steps;
  }

  void note_implicit() const {
    if (!implicit_) return;
    const ImplicitMotion::Report report = implicit_->report();
    observer_.detail(fmt::format("{} implicit steps, {} Newton iterations, {} multigrid iterations, at most {} in one",
                                 report.steps, report.newton_iterations, report.solves.iterations, report.solves.most));
    if (report.halvings > 0) {
      observer_.note(
          fmt::format("{} implicit steps found no end, or made energy from nowhere, and were made again in halves",
                      report.halvings));
    }
    if (report.solves.fallbacks > 0) {
      observer_.note(
          fmt::format("multigrid did not converge in {} of {} linear solves; the slower direct solver took "
                      "over",
                      report.solves.fallbacks, report.solves.solves));
    }
  }

  /// Once, when enough is done to tell.
  void judge_long_run() {
    if (is_judged_ || progress_->seconds() < kSecondsToEstimate) return;
    is_judged_ = true;
    const double seconds = progress_->seconds_to_go();
    if (seconds > scene_.solver.time_limit) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("the simulation would take about {}, longer than --time-limit ({}); {}",
                              duration_text(seconds), duration_text(scene_.solver.time_limit), remedy_for(plan_)));
    }
    if (seconds < kLongRun) return;
    observer_.warn(fmt::format("the simulation needs about {} more; {}", duration_text(seconds), remedy_for(plan_)));
  }

  World& world_;
  const Scene& scene_;
  const Observer& observer_;
  bool whole_frames_;
  double size_;  // m, of the largest body
  SceneDriver driver_;
  OverlapWatch overlaps_;
  StepPlan plan_;
  std::optional<ImplicitMotion> implicit_;
  double total_;
  double before_ = 0;  // of that, done by an earlier run
  std::optional<Progress> progress_;
  AdaptiveIntegrator motion_;
  bool is_judged_ = false;
};

Recording record_motion(Production& production, const Scene& scene, const Observer& observer, RunCache* cache) {
  const int frames = frame_count(scene);
  Recorder recorder(scene, production, "time_s", cache);
  Runner runner(production, scene, observer, cache != nullptr);
  const int first = recorder.take_up(production.world, [&](IntegratorState& state) { runner.serialize(state); });
  runner.begin_at(first);
  for (int frame = first; frame < frames; ++frame) {
    observer.check_interrupt();
    if (frame > 0) runner.run_frame(frame);
    recorder.add(frame / scene.fps, runner.pin_reactions(), time_of(scene, frame), false, runner.state());
  }
  runner.finish(first, frames);
  recorder.recording().deepest_penetration = runner.deepest();
  return recorder.finish();
}

}  // namespace

Recording simulate(Production& production, const Scene& scene, const Observer& observer, RunCache* cache) {
  switch (scene.solver.scheme) {
    case Solver::kStatic:
    case Solver::kLinear:
      return record_equilibria(production, scene, observer, cache);
    case Solver::kModes:
      return record_modes(production, scene, observer, cache);
    case Solver::kAuto:
    case Solver::kEuler:
    case Solver::kVerlet:
    case Solver::kImplicitEuler:
    case Solver::kBdf2:
      break;
  }
  return record_motion(production, scene, observer, cache);
}

}  // namespace sprung
