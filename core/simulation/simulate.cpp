#include "core/simulation/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/simulation/crossing_watch.h"
#include "core/simulation/equilibria.h"
#include "core/simulation/motion.h"
#include "core/simulation/observer.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr double kLongRun = 3600;  // s remaining, from which on there is a warning
constexpr double kSecondsToEstimate = 3;
constexpr double kRest = 0.25;   // s without motion
constexpr double kSeen = 0.001;  // of the largest body's size: crossings that are deeper show in pictures

int inverted_bricks(const World& world) {
  int count = 0;
  for (const SoftBody& body : world.bodies) count += inverted_bricks(body);
  return count;
}

/// "skins cross by at most 0.3 mm (0.2 % of the size)".
std::string summary_of(const std::vector<Crossings>& frames) {
  const Crossings* deepest = deepest_of(frames);
  if (deepest == nullptr) return "no skins cross";
  return fmt::format("skins cross by at most {} ({:.2g} % of the size)", readable(deepest->depth, Dimension::kLength),
                     100 * deepest->share);
}

void warn_of_crossings(const std::vector<Crossings>& frames, const Observer& observer) {
  const Crossings* deepest = deepest_of(frames);
  if (deepest == nullptr || deepest->share <= kSeen) return;
  observer.warn(fmt::format(
      "in frame {} skins cross in {} of triangles, {} deep ({:.2g} % of the size): {}, at [{:.4g}, {:.4g}, {:.4g}] m; "
      "smaller bricks (bricks) or slower impacts keep them apart",
      deepest->frame + 1, count_of(deepest->pairs, "pair"), readable(deepest->depth, Dimension::kLength),
      100 * deepest->share, deepest->names, deepest->position.x(), deepest->position.y(), deepest->position.z()));
}

void forecast(const StepPlan& plan, double brick_steps, const Observer& observer) {
  if (!plan.reason.empty()) observer.note("integrator " + plan.reason);
  const Steps& steps = plan.steps;
  observer.detail(fmt::format("step {}, {} steps a frame, {:.3g} brick-steps in all",
                              readable(steps.dt, Dimension::kTime), steps.count, brick_steps));
  if (const std::string warning = warning_of(plan); !warning.empty()) observer.warn(warning);
}

/// Runs a motion frame by frame and reports on it.
class MotionRun {
 public:
  MotionRun(Simulation& simulation, const Scene& scene, const Observer& observer)
      : world_(simulation.world),
        scene_(scene),
        observer_(observer),
        size_(simulation.size),
        motion_(simulation, scene),
        watch_(scene, simulation),
        total_(motion_.plan().brick_steps * (frame_count(scene) - 1)) {
    forecast(motion_.plan(), total_, observer);
  }

  /// The first frame to compute: earlier ones exist.
  void begin_at(int frame) {
    before_ = frame == 0 ? 0 : motion_.plan().brick_steps * (frame - 1);
    progress_.emplace(observer_, "simulate", total_ - before_, 1e-6, "M brick-steps/s");
  }

  /// From the previous frame to this one.
  void run_frame(int frame) {
    const double begin = time_of(scene_, frame - 1);
    const double duration = 1 / scene_.fps;
    const std::vector<Points> before = positions();
    const auto between = [&](double share) {
      observer_.check_interrupt();
      progress_->update(total_ * (begin + share * duration) / time_of(scene_, frame_count(scene_) - 1) - before_);
      judge_long_run();
    };
    motion_.advance(begin, time_of(scene_, frame), duration, between,
                    [&](const std::string& message) { observer_.warn(message); });
    std::vector<const Points*> nodes;
    for (const SoftBody& body : world_.bodies) nodes.push_back(&body.positions);
    crossings_.push_back(watch_.look(nodes, frame, time_of(scene_, frame)));
    observer_.look_at(crossings_.back());
    still_for_ = is_still(before, duration) ? still_for_ + duration : 0;
  }

  /// Whether the scene ends with this frame since nothing moves any more.
  [[nodiscard]] bool has_come_to_rest(int frame) const {
    return scene_.until_still && time_of(scene_, frame) >= *scene_.until_still && still_for_ >= kRest;
  }

  void serialize(IntegratorState& state) {
    motion_.serialize(state);
    if (scene_.until_still) state.serialize(still_for_);
  }

  /// Of `frames` frames, of which this run computed those from `first` on.
  void finish(int first, int frames) {
    note_implicit();
    note_steps();
    const int inverted = inverted_bricks(world_);
    const bool has_more = !motion_.plan().is_implicit() && world_.bodies.size() > 1;  // each with its own steps
    const Steps& steps = motion_.plan().steps;
    progress_->finish(fmt::format(
        "{}{}, {}{} steps of {} a frame, {} inverted bricks at the end, {}", count_of(frames, "frame"),
        first > 0 ? fmt::format(", {} of them in this run", frames - first) : "", has_more ? "at most " : "",
        steps.count, readable(steps.dt, Dimension::kTime), inverted, summary_of(crossings_)));
    warn_of_inverted_bricks(world_, observer_);
    warn_of_crossings(crossings_, observer_);
  }

  [[nodiscard]] SceneMotion& motion() { return motion_; }
  [[nodiscard]] const std::vector<Crossings>& crossings() const { return crossings_; }

 private:
  [[nodiscard]] std::vector<Points> positions() const {
    std::vector<Points> all;
    for (const SoftBody& body : world_.bodies) all.push_back(body.positions);
    return all;
  }

  /// Whether all nodes moved so little in `duration` (s), since they were at `before`, that a vibration of a second's
  /// period or less would be within 1 % of the size.
  [[nodiscard]] bool is_still(const std::vector<Points>& before, double duration) const {
    const double most = std::min(0.01, 0.06 * duration) * size_;
    for (std::size_t row = 0; row < before.size(); ++row) {
      const Points& now = world_.bodies[row].positions;
      if ((now - before[row]).rowwise().norm().maxCoeff() > most) return false;
    }
    return true;
  }

  void note_implicit() const {
    const std::optional<ImplicitMotion::Report> report = motion_.implicit_report();
    if (!report) return;
    const SolveReport& solves = report->solves;
    observer_.detail(fmt::format("{} implicit steps, {} Newton iterations, {} multigrid iterations, at most {} in one",
                                 report->steps, report->newton_iterations, solves.iterations, solves.most));
    if (report->halvings > 0) {
      observer_.note(
          fmt::format("{} implicit steps did not converge, or gained energy, and were retried with half the time step",
                      report->halvings));
    }
    if (solves.fallbacks > 0) {
      observer_.note(
          fmt::format("multigrid did not converge in {} of {} linear solves; the slower direct solver took over",
                      solves.fallbacks, solves.solves));
    }
  }

  void note_steps() const {
    const StepReport& report = motion_.report();
    const GuardCounts& counts = report.guard;
    if (counts.steps == 0) return;
    const double percent = 100 / (report.springs + report.search + report.sweeps + report.guarding);
    observer_.detail(
        fmt::format("time of the steps: springs {:.0f} %, search {:.0f} %, sweeps {:.0f} %, guard {:.0f} %; {:.3g} "
                    "contacts with a load in all",
                    percent * report.springs, percent * report.search, percent * report.sweeps,
                    percent * report.guarding, report.contacts));
    observer_.detail(fmt::format(
        "guard against crossings: acted in {} of {} steps, slowed nodes down in {}, let nodes move as one in {}",
        counts.impulses, counts.steps, counts.slowed, counts.welded));
    if (counts.failed > 0) {
      observer_.warn(
          fmt::format("the guard against crossings failed in {} of {} steps: parts that pins or obstacles "
                      "move meet there; keep them apart",
                      counts.failed, counts.steps));
    }
  }

  /// Once, when enough is done for an estimate.
  void judge_long_run() {
    if (is_judged_ || progress_->seconds() < kSecondsToEstimate) return;
    is_judged_ = true;
    const double seconds = progress_->seconds_to_go();
    const std::string_view remedy = remedy_for(motion_.plan());
    if (seconds > scene_.solver.time_limit) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("the simulation would take about {}, longer than --time-limit ({}); {}",
                              duration_text(seconds), duration_text(scene_.solver.time_limit), remedy));
    }
    if (seconds < kLongRun) return;
    observer_.warn(fmt::format("the simulation needs about {} more; {}", duration_text(seconds), remedy));
  }

  World& world_;
  const Scene& scene_;
  const Observer& observer_;
  double size_;  // m, of the largest body
  SceneMotion motion_;
  CrossingWatch watch_;
  std::vector<Crossings> crossings_;  // by frame of this run
  double total_;
  double still_for_ = 0;  // s, up to the last frame
  double before_ = 0;     // of these, done by an earlier run
  std::optional<Progress> progress_;
  bool is_judged_ = false;
};

Recording record_motion(Simulation& simulation, const Scene& scene, const Observer& observer, RunCache* cache) {
  const int frames = frame_count(scene);
  Recorder recorder(scene, simulation, "time_s", cache);
  MotionRun run(simulation, scene, observer);
  const int first = recorder.resume_from_cache(simulation.world, [&](IntegratorState& state) { run.serialize(state); });
  run.begin_at(first);
  int frame = first;
  for (; frame < frames && !(frame > 0 && run.has_come_to_rest(frame - 1)); ++frame) {
    observer.check_interrupt();
    if (frame > 0) run.run_frame(frame);
    IntegratorState state;
    run.serialize(state);
    recorder.add(frame / scene.fps, scene.probes.empty() ? std::vector<Points>{} : run.motion().pin_reactions(),
                 time_of(scene, frame), false, state);
    observer.finish_frame(frame, frame / scene.fps, simulation.world);
  }
  run.finish(first, frame);
  recorder.recording().crossings = run.crossings();
  recorder.recording().guard = run.motion().report().guard;
  recorder.recording().brick_steps = run.motion().brick_steps();
  recorder.recording().inverted_bricks = inverted_bricks(simulation.world);
  return recorder.finish();
}

}  // namespace

Recording simulate(Simulation& simulation, const Scene& scene, const Observer& observer, RunCache* cache) {
  switch (scene.solver.scheme) {
    case Solver::kStatic:
    case Solver::kLinear:
      return record_equilibria(simulation, scene, observer, cache);
    case Solver::kModes:
      return record_modes(simulation, scene, observer, cache);
    case Solver::kAuto:
    case Solver::kEuler:
    case Solver::kVerlet:
    case Solver::kImplicitEuler:
    case Solver::kBdf2:
      break;
  }
  return record_motion(simulation, scene, observer, cache);
}

}  // namespace sprung
