#include "core/motion/integrator.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <vector>

#include "core/body/forces.h"
#include "core/error.h"
#include "core/world/impulses.h"

namespace sprung {
namespace {

/// One actor on its way through a number of steps.
class Mover {
 public:
  Mover(Actor& actor, const World& world)
      : actor_(actor),
        world_(world),
        inverse_masses_(actor.body.masses.cwiseInverse()),
        impulses_(actor, without_held(inverse_masses_, actor)) {}

  /// velocities += dt (forces / m + gravity - alpha v); held nodes keep their velocity.
  void kick(double dt) {
    Body& body = actor_.body;
    if (body.model == Model::kFem) {
      settle();
      spring_forces(body, workspace_, forces_);
      body.velocities *= 1 - dt * body.damping.alpha;
      body.velocities += dt * (inverse_masses_.asDiagonal() * forces_);
      body.velocities.rowwise() += dt * world_.gravity.transpose();
    } else {
      workspace_.springs.move(body, pending_drift_, dt, world_.gravity, inverse_masses_);
      pending_drift_ = 0;
    }
    for (const HeldNode& held : actor_.pinned) {
      for (int axis = 0; axis < 3; ++axis) {
        if (held.axes[static_cast<std::size_t>(axis)]) body.velocities(held.node, axis) = held.velocity[axis];
      }
    }
  }

  void keep_limits(double dt) { impulses_.apply(world_, dt, actor_); }

  /// positions += dt velocities: put off to the next kick, which has them at hand anyway.
  void drift(double dt) { pending_drift_ += dt; }

  /// Does what was put off.
  void settle() {
    if (pending_drift_ != 0) actor_.body.positions += pending_drift_ * actor_.body.velocities;
    pending_drift_ = 0;
  }

 private:
  static Eigen::VectorXd without_held(Eigen::VectorXd inverse_masses, const Actor& actor) {
    for (const HeldNode& held : actor.pinned) inverse_masses[held.node] = 0;
    return inverse_masses;
  }

  Actor& actor_;
  const World& world_;
  Eigen::VectorXd inverse_masses_;
  Impulses impulses_;
  ForceWorkspace workspace_;
  Points forces_;
  double pending_drift_ = 0;  // s
};

void check_finite(const World& world, double time) {
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    if (world.actors[i].body.positions.allFinite()) continue;
    throw Error(ErrorKind::kDiverged,
                fmt::format("body {} has a position that is not finite at t = {:.6g} s: the motion diverged; use more "
                            "bricks, a stiffer material or a shorter fall",
                            i + 1, time));
  }
}

/// v += dt a; x += dt v. First order, symplectic.
void euler(Mover& mover, double dt, long steps) {
  for (long step = 0; step < steps; ++step) {
    mover.kick(dt);
    mover.keep_limits(dt);
    mover.drift(dt);
  }
}

/// Half a kick, drift, half a kick; the half kicks that meet between two steps are one. Second order, symplectic.
void verlet(Mover& mover, double dt, long steps) {
  for (long step = 0; step < steps; ++step) {
    mover.kick(step == 0 ? dt / 2 : dt);
    mover.keep_limits(dt);
    mover.drift(dt);
  }
  if (steps > 0) mover.kick(dt / 2);
}

}  // namespace

void advance(World& world, Scheme scheme, std::span<const Steps> steps, double time) {
  const auto advance_actor = [&](std::size_t i) {
    Mover mover(world.actors[i], world);
    if (scheme == Scheme::kVerlet) {
      verlet(mover, steps[i].dt, steps[i].count);
    } else {
      euler(mover, steps[i].dt, steps[i].count);
    }
    mover.settle();
  };
  // A thread that waits within one actor's steps must not begin another actor's: the first would stand still.
  tbb::parallel_for(std::size_t{0}, world.actors.size(),
                    [&](std::size_t i) { tbb::this_task_arena::isolate([&] { advance_actor(i); }); });
  if (!steps.empty()) check_finite(world, time + steps[0].dt * static_cast<double>(steps[0].count));
}

void advance(World& world, Scheme scheme, double dt, long steps, double time) {
  advance(world, scheme, std::vector<Steps>(world.actors.size(), {.count = steps, .dt = dt}), time);
}

}  // namespace sprung
