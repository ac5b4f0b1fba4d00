#include "core/dynamics/explicit/integrator.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/body/body.h"
#include "core/body/brick_hessian.h"
#include "core/body/forces.h"
#include "core/contact/broad_phase.h"
#include "core/contact/contact_states.h"
#include "core/dynamics/explicit/foundation_step.h"
#include "core/dynamics/explicit/split_damping.h"
#include "core/dynamics/linear/eigenvalue_bound.h"
#include "core/error.h"
#include "core/world/load_forces.h"

namespace sprung {
namespace {

/// The fastest vibration of the body in its current state.
double fastest_vibration_squared(const Body& body) {
  SpringSystem bricks;
  const Eigen::Index nodes = body.node_count();
  const auto multiply = [&](const Eigen::VectorXd& u, Eigen::VectorXd& forces) { bricks.multiply(body, u, forces); };
  const auto accelerate = [&](const Eigen::VectorXd& forces, Eigen::VectorXd& accelerations) {
    accelerations.resize(forces.size());
    for (Eigen::Index node = 0; node < nodes; ++node) {
      accelerations.segment<3>(3 * node) = forces.segment<3>(3 * node) / body.masses[node];
    }
  };
  return bound_on_eigenvalues<Eigen::VectorXd>(3 * nodes, multiply, accelerate);
}

}  // namespace

double largest_frequency_squared(const Body& body) {
  if (body.model == Model::kCalibrated) return fastest_vibration_squared(body);
  double share = 0;
  for (const double scale : body.stiffness_scale) share += scale;
  const double corner_mass = body.masses.sum() / share / 8;
  return largest_brick_stiffness(body) / corner_mass;
}

/// Leapfrog with damping c = alpha + beta omega^2 is stable while omega^2 dt^2 + 2 c dt < 4.
double stable_step(const Body& body, double safety) {
  const double squared = largest_frequency_squared(body);
  const Rayleigh ours = damping_shares(body, squared).of_steps;
  const double damping = ours.alpha + ours.beta * squared;
  return safety * 4 / (damping + std::sqrt(damping * damping + 4 * squared));
}

double stable_step(const World& world, double safety) {
  double step = std::numeric_limits<double>::infinity();
  for (const SoftBody& body : world.bodies) step = std::min(step, stable_step(body, safety));
  return step;
}

double stable_step(const World& world, const std::vector<std::size_t>& bodies) {
  double step = std::numeric_limits<double>::infinity();
  for (const std::size_t row : bodies) step = std::min(step, stable_step(world.bodies[row]));
  return step;
}

Steps equal_steps(double time, double longest) {
  const long count = std::max(1L, long(std::ceil(time / longest)));
  return {.count = count, .dt = time / double(count)};
}

namespace {

/// One body during a number of steps.
class BodyStepper {
 public:
  BodyStepper(SoftBody& body, const World& world, double elapsed)
      : body_(body),
        world_(world),
        inverse_masses_(body.masses.cwiseInverse()),
        frequency_squared_(largest_frequency_squared(body)),
        damping_(damping_shares(body, frequency_squared_)),
        split_damping_(body, damping_.split_beta, frequency_squared_),
        loads_(body, world),
        foundation_(body, elapsed) {}

  /// velocities += dt (forces / m + gravity - alpha v); pinned nodes keep their velocity. Damping sees the velocities
  /// that the last step left, not what loads, gravity or springs add here: at rest these balance each other or contact.
  /// `step`: s, of the drift that follows.
  void kick(double dt, double step) {
    Body& body = body_;
    if (split_damping_.add(dt)) {
      settle();
      split_damping_.settle();
    }
    const Points* loads = nullptr;
    if (loads_.any()) {
      settle();
      loads = &loads_.forces();
    }
    if (!has_tiles(body.model)) {
      settle();
      spring_forces(body, workspace_, forces_);
      body.velocities *= 1 - dt * body.damping.alpha;
      body.velocities += dt * (inverse_masses_.asDiagonal() * forces_);
      body.velocities.rowwise() += dt * world_.gravity.transpose();
    } else {
      workspace_.springs.move(
          body, {.drift = pending_drift_, .kick = dt, .damping = damping_.of_steps, .gravity = world_.gravity},
          inverse_masses_);
      pending_drift_ = 0;
    }
    if (loads != nullptr) body.velocities += dt * (inverse_masses_.asDiagonal() * *loads);
    foundation_.apply(body_, dt, step);
    for (const KinematicNode& pinned : body_.pinned) {
      for (int axis = 0; axis < 3; ++axis) {
        if (pinned.axes[axis]) body.velocities(pinned.node, axis) = pinned.velocity[axis];
      }
    }
  }

  /// positions += dt velocities: deferred to the next kick, which loads them anyway.
  void drift(double dt) {
    pending_drift_ += dt;
    foundation_.pass(dt);
  }

  /// Called after the last of a number of steps.
  void finish() {
    settle();
    split_damping_.settle();
  }

  /// Applies the deferred drift.
  void settle() {
    if (pending_drift_ != 0) body_.positions += pending_drift_ * body_.velocities;
    pending_drift_ = 0;
  }

 private:
  SoftBody& body_;
  const World& world_;
  Eigen::VectorXd inverse_masses_;
  double frequency_squared_;  // 1/s^2, of the fastest vibration
  DampingShares damping_;
  SplitDamping split_damping_;
  LoadForces loads_;
  FoundationStep foundation_;
  ForceWorkspace workspace_;
  Points forces_;
  double pending_drift_ = 0;  // s
};

/// 1/kg, per node; 0 for pinned nodes.
Eigen::VectorXd inverse_masses_of(const SoftBody& body) {
  Eigen::VectorXd inverse_masses = body.masses.cwiseInverse();
  for (const KinematicNode& pinned : body.pinned) inverse_masses[pinned.node] = 0;
  return inverse_masses;
}

/// The fastest vibration of a brick that is being flattened grows at least as one over its volume: it is looked at anew
/// whenever a brick below kFlat is about to lose a fifth of what it had. Below kFlattest the law's stiffness grows no
/// more.
constexpr double kFlat = 0.5;
constexpr double kFlattest = 0.02;
constexpr double kFlattening = 0.8;
constexpr double kMaxShortening = 100;  // of a step, at a time: a brick that is flat vibrates that much faster

/// Bodies that touch each other, during a number of steps.
class GroupStepper {
 public:
  GroupStepper(World& world, const std::vector<std::size_t>& bodies, double elapsed, const ContactStates& states)
      : world_(world), elapsed_(elapsed), contacts_(states.of(bodies)) {
    for (const std::size_t i : bodies) {
      inverse_masses_.push_back(inverse_masses_of(world.bodies[i]));
      steppers_.push_back(std::make_unique<BodyStepper>(world.bodies[i], world, elapsed));
    }
  }

  void kick(double dt, double step) {
    Stopwatch watch;
    each([&](BodyStepper& stepper) { stepper.kick(dt, step); });
    contacts_.count_springs(watch.lap());
  }

  void apply_contact(double dt) {
    contacts_.apply(world_, inverse_masses_, elapsed_, dt);
    elapsed_ += dt;
    const FlattestVolume volume = contacts_.flattest();
    if (!first_volume_) first_volume_ = std::clamp(volume.now, kFlattest, kFlat);
    is_stiffer_ = std::max(volume.next, kFlattest) < kFlattening * *first_volume_;
  }

  /// Whether bricks have been flattened so much since the first step that it may have become too long.
  [[nodiscard]] bool is_stiffer() const { return is_stiffer_; }

  void drift(double dt) {
    for (const auto& stepper : steppers_) stepper->drift(dt);
  }

  void finish() {
    each([&](BodyStepper& stepper) { stepper.finish(); });
  }

 private:
  template <class Visit>
  void each(const Visit& visit) {
    if (steppers_.size() == 1) {
      visit(*steppers_.front());
      return;
    }
    tbb::parallel_for(std::size_t{0}, steppers_.size(),
                      [&](std::size_t i) { tbb::this_task_arena::isolate([&] { visit(*steppers_[i]); }); });
  }

  const World& world_;
  double elapsed_;
  std::vector<std::unique_ptr<BodyStepper>> steppers_;
  std::vector<Eigen::VectorXd> inverse_masses_;
  SweptContacts& contacts_;
  std::optional<double> first_volume_;  // of the flattest brick, before the first step
  bool is_stiffer_ = false;
};

void check_finite(const World& world, double time) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    if (world.bodies[i].positions.allFinite()) continue;
    throw Diverged(i, fmt::format("body {} has a position that is not finite at t = {:.6g} s: the motion diverged; use "
                                  "more bricks, a stiffer material or a shorter fall",
                                  i + 1, time));
  }
}

/// v += dt a; x += dt v. First order, symplectic. Returns the number of steps taken: fewer where bricks were flattened.
long euler(GroupStepper& stepper, double dt, long steps) {
  long step = 0;
  while (step < steps && !stepper.is_stiffer()) {
    stepper.kick(dt, dt);
    stepper.apply_contact(dt);
    stepper.drift(dt);
    ++step;
  }
  return step;
}

/// Half a kick, drift, half a kick; the half kicks that meet between two steps are one. Second order, symplectic.
/// Returns the number of steps likewise.
long verlet(GroupStepper& stepper, double dt, long steps) {
  long step = 0;
  while (step < steps && !stepper.is_stiffer()) {
    stepper.kick(step == 0 ? dt / 2 : dt, dt);
    stepper.apply_contact(dt);
    stepper.drift(dt);
    ++step;
  }
  if (step > 0) stepper.kick(dt / 2, dt);
  return step;
}

void advance_group(World& world, Scheme scheme, GroupSteps& group, const ContactStates& states) {
  Steps planned = group.steps;
  Steps all{.count = 0, .dt = planned.dt};
  double elapsed = group.elapsed;
  while (planned.count > 0) {
    GroupStepper stepper(world, group.bodies, elapsed, states);
    const long taken = (scheme == Scheme::kVerlet ? verlet : euler)(stepper, planned.dt, planned.count);
    stepper.finish();
    elapsed += double(taken) * planned.dt;
    all.count += taken;
    planned.count -= taken;
    if (planned.count == 0) break;
    const double stable = group.share * stable_step(world, group.bodies);
    if (!(stable < planned.dt)) continue;  // nor where a number is not finite
    planned = equal_steps(double(planned.count) * planned.dt, std::max(stable, planned.dt / kMaxShortening));
    all.dt = std::min(all.dt, planned.dt);
  }
  group.steps = all;
}

}  // namespace

void advance(World& world, Scheme scheme, std::span<GroupSteps> groups, double time, const ContactStates& states) {
  const double end = groups.empty() ? time : time + groups[0].steps.dt * double(groups[0].steps.count);
  // A thread that waits within one group's steps must not begin another group's: the first would stand still.
  try {
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t i) {
      tbb::this_task_arena::isolate([&] { advance_group(world, scheme, groups[i], states); });
    });
  } catch (const Diverged&) {
    check_finite(world, time);
    throw;
  }
  if (!groups.empty()) check_finite(world, end);
}

void advance(World& world, Scheme scheme, double dt, long steps, double time) {
  const double duration = dt * double(steps);
  const std::vector<std::vector<std::size_t>> bodies = contact_groups(world, duration);
  ContactStates states;
  states.begin_frame(world, bodies);
  constexpr double kAnyStep = std::numeric_limits<double>::infinity();
  std::vector<GroupSteps> groups;
  groups.reserve(bodies.size());
  for (const std::vector<std::size_t>& rows : bodies) {
    groups.push_back({.bodies = rows, .steps = {.count = steps, .dt = dt}, .share = kAnyStep});
  }
  advance(world, scheme, groups, time, states);
  move_prescribed(world, duration);
}

}  // namespace sprung
