#include "core/simulation/equilibria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/inversion_guard.h"
#include "core/dynamics/statics/modes.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/drivers.h"
#include "core/simulation/observer.h"
#include "core/simulation/skin_supports.h"
#include "core/text.h"
#include "core/world/load_forces.h"

namespace sprung {
namespace {

constexpr double kModeSwing = 0.1;  // of the body's size

/// Finds the equilibria of the bodies under a fraction of the load.
class Loading {
 public:
  Loading(Simulation& simulation, const Scene& scene)
      : simulation_(simulation), scene_(scene), is_linear_(scene.solver.scheme == Solver::kLinear) {
    for (std::size_t row = 0; row < simulation.origins.size(); ++row) {
      if (!simulation.world.bodies[row].pinned.empty() || !simulation.origins[row].pinned_skins.empty()) continue;
      throw Error(ErrorKind::kBadInput,
                  "a body without pins has no equilibrium; give it a [[body.pin]], or use "
                  "solver.scheme euler or verlet");
    }
    const auto wholes = forced_wholes(scene, simulation.origins);
    for (std::size_t i = 0; i < simulation.origins.size(); ++i) {
      systems_.push_back(make_default_solver());
      full_.push_back(loads_and_weight(scene, simulation, i, wholes[i]));
    }
  }

  /// The shapes under a fraction of the weight, with the pins as at a time (s). Reactions by body, m x 3, N.
  std::vector<Points> apply(double share, double time, const std::function<void()>& between) {
    std::vector<Points> reactions_of_all;
    for (std::size_t row = 0; row < simulation_.world.bodies.size(); ++row) {
      SoftBody& body = simulation_.world.bodies[row];
      Loads loads = full_[row];
      loads.forces *= share;
      for (SkinPressure& pressure : loads.pressures) pressure.pressure *= share;
      const Points movements = pin_movements(scene_, simulation_, row, time, is_linear_);
      set_foundations(scene_, simulation_.origins[row], time, is_linear_, body);
      const Supports supports = supports_of(body);
      reactions_of_all.push_back(
          settle(body, supports, loads, movements, is_linear_, *systems_[row], iterations_, between));
    }
    return reactions_of_all;
  }

  [[nodiscard]] bool is_linear() const { return is_linear_; }
  [[nodiscard]] int iterations() const { return iterations_; }

  /// Reports the fallbacks of the linear solvers, if any.
  void note_fallbacks(const Observer& observer) const {
    for (std::size_t i = 0; i < systems_.size(); ++i) {
      const SolveReport report = systems_[i]->report();
      observer.detail(fmt::format("body {}: {} linear solves, {} multigrid iterations, at most {} in one", i + 1,
                                  report.solves, report.iterations, report.most));
      if (report.fallbacks == 0) continue;
      observer.note(
          fmt::format("body {}: multigrid did not converge in {} of {} linear solves; the slower direct solver "
                      "took over",
                      i + 1, report.fallbacks, report.solves));
    }
  }

 private:
  Simulation& simulation_;
  const Scene& scene_;
  bool is_linear_;
  std::vector<std::unique_ptr<LinearSolver>> systems_;  // by body
  std::vector<Loads> full_;                             // the same
  int iterations_ = 0;
};

/// An option may change the solver after the scene file was checked.
void check_rests(const Scene& scene) {
  if (const std::vector<MotionOnly> parts = motion_only(scene); !parts.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("only a motion (scheme euler or verlet) can have {}", parts.front().what));
  }
  if (scene.obstacles.empty()) return;
  throw Error(ErrorKind::kBadInput,
              "only a motion (scheme euler or verlet) meets obstacles; leave out [[obstacle]], and pin what carries "
              "the body");
}

}  // namespace

namespace {

/// Forces and moments of loads and reactions (m x 3, N) at `positions` (m x 3, m) must cancel: checked by sums alone,
/// independently of the solver. A millionth may remain.
void check_balance(const Points& positions, const Points& loads, const Points& reactions) {
  constexpr double kLeft = 1e-6;
  const Vec3 middle = positions.colwise().mean();
  Vec3 force = Vec3::Zero();
  Vec3 moment = Vec3::Zero();
  double forces = 0;
  double moments = 0;
  for (Eigen::Index node = 0; node < positions.rows(); ++node) {
    const Vec3 arm = positions.row(node).transpose() - middle;
    for (const Points* kind : {&loads, &reactions}) {
      const Vec3 here = kind->row(node);
      force += here;
      moment += arm.cross(here);
      forces += here.norm();
      moments += arm.norm() * here.norm();
    }
  }
  if (force.norm() <= kLeft * forces && moment.norm() <= kLeft * moments) return;
  throw Error(ErrorKind::kFailed,
              fmt::format("the reactions do not balance the loads: {:.2g} of the forces and {:.2g} of the moments are "
                          "left unbalanced; support more of the body, or use fewer bricks where it is slender",
                          force.norm() / forces, moment.norm() / moments));
}

}  // namespace

Points settle(SoftBody& body, const Supports& supports, const Loads& loads, const Points& movements, bool linear,
              LinearSolver& solver, int& newton_steps, const std::function<void()>& between) {
  constexpr int kMaxTurns = 60;
  constexpr double kTurned = 1e-7;  // of the forces at work
  if (linear) {
    body.positions = body.rest_positions;
    const Points forces = loads.forces + pressure_forces(body, loads.pressures);
    const LinearResponse response = linear_response(body, supports, forces, movements, solver);
    body.positions += response.displacements;
    check_balance(body.rest_positions, forces, response.reactions);
    return response.reactions;
  }
  Points start = body.positions;
  Points pressures = pressure_forces(body, loads.pressures);
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (supports.fixed[i]) body.positions.data()[i] = body.rest_positions.data()[i] + movements.data()[i];
  }
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const Points forces = loads.forces + pressures;
    newton_steps += solve_static(body, supports, forces, start, solver, {.between = between}).iterations;
    Points pin_forces = reactions(body, supports, forces);
    const Points turned = pressure_forces(body, loads.pressures);
    if ((turned - pressures).norm() <= kTurned * (forces.norm() + pin_forces.norm())) {
      check_balance(body.positions, forces, pin_forces);
      return pin_forces;
    }
    pressures = turned;
    start = body.positions;
  }
  throw Error(ErrorKind::kDiverged,
              fmt::format("a pressure that follows the skin did not converge in {} iterations; use more load steps, or "
                          "less pressure",
                          kMaxTurns));
}

Recording record_equilibria(Simulation& simulation, const Scene& scene, const Observer& observer, RunCache* cache) {
  check_rests(scene);
  const int frames = frame_count(scene);
  Loading loading(simulation, scene);
  Recorder recorder(scene, simulation, "load", cache);
  const int first = recorder.resume_from_cache(simulation.world, [](IntegratorState&) {});
  Progress progress(observer, loading.is_linear() ? "linear" : "static", frames);
  for (int frame = first; frame < frames; ++frame) {
    observer.check_interrupt();
    const double share = frames == 1 ? 1.0 : double(frame) / (frames - 1);
    // The first of several frames is at rest: no load, no displacement.
    const std::vector<Points> reactions =
        share == 0 ? std::vector<Points>{}
                   : loading.apply(share, time_of(scene, frame), [&] { observer.check_interrupt(); });
    recorder.add(share, reactions, time_of(scene, frame), loading.is_linear());
    observer.finish_frame(frame, share, simulation.world);
    progress.update(frame + 1);
  }
  loading.note_fallbacks(observer);
  progress.finish(loading.is_linear() ? fmt::format("{} frames", frames)
                                      : fmt::format("{} frames, {} Newton steps", frames, loading.iterations()));
  if (!loading.is_linear()) warn_of_inverted_bricks(simulation.world, observer);
  return recorder.finish();
}

Recording record_modes(Simulation& simulation, const Scene& scene, const Observer& observer, RunCache* cache) {
  check_rests(scene);
  if (simulation.world.bodies.size() != 1) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("modes are computed for one body; the scene has {}", simulation.world.bodies.size()));
  }
  Progress progress(observer, "modes");
  SoftBody& body = simulation.world.bodies[0];
  const Modes modes = natural_modes(body, supports_of(body), scene.solver.modes, [&] { observer.check_interrupt(); });
  const int frames = frame_count(scene);
  const int count = scene.solver.modes;
  Recorder recorder(scene, simulation, "mode", cache);
  const int first = recorder.resume_from_cache(simulation.world, [](IntegratorState&) {});
  for (int frame = first; frame < frames; ++frame) {
    const double place = double(frame) * count / frames;
    const int mode = std::min(int(place), count - 1);
    const Eigen::VectorXd shape = modes.shapes.col(mode) / modes.shapes.col(mode).cwiseAbs().maxCoeff();
    const double swing = kModeSwing * simulation.size * std::sin(2 * std::numbers::pi * (place - mode));
    body.positions = body.rest_positions;
    Eigen::Map<Eigen::VectorXd>(body.positions.data(), shape.size()) += swing * shape;
    recorder.add(mode + 1, {}, 0, true);
    observer.finish_frame(frame, mode + 1, simulation.world);
  }
  recorder.recording().frequencies = modes.frequencies;
  if (modes.rigid > 0) {
    observer.note(fmt::format("{} {} set aside", count_of(modes.rigid, "free rigid-body motion"),
                              modes.rigid == 1 ? "is" : "are"));
  }
  progress.finish(fmt::format("{} modes, the lowest at {:.6g} Hz", count, modes.frequencies[0]));
  return recorder.finish();
}

void warn_of_inverted_bricks(const World& world, const Observer& observer) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const int inverted = inverted_bricks(body);
    if (inverted == 0) continue;
    observer.warn(
        fmt::format("body {}: of {} bricks {} are inverted at the end: the material is too soft for its weight, its "
                    "impact or its pins; use a stiffer or lighter material (young, density) or a smaller body",
                    i + 1, body.grid.brick_count(), inverted));
  }
}

}  // namespace sprung
