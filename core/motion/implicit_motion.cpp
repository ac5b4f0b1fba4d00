#include "core/motion/implicit_motion.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/motion/diverged.h"
#include "core/motion/implicit_stepper.h"
#include "core/motion/why_not_implicit.h"

namespace sprung {
namespace {

constexpr int kMostHalvings = 8;

}  // namespace

ImplicitMotion::ImplicitMotion(World& world, const ImplicitOptions& options) : world_(world), options_(options) {
  const std::string why_not = why_not_implicit(world);
  if (!why_not.empty()) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}, which implicit steps know nothing of: use an explicit scheme, euler or verlet", why_not));
  }
  for (Actor& actor : world.actors) steppers_.push_back(std::make_unique<ImplicitStepper>(actor, world, options_));
}

ImplicitMotion::~ImplicitMotion() = default;

void ImplicitMotion::advance(double dt, long steps, double time) {
  for (std::size_t actor = 0; actor < steppers_.size(); ++actor) {
    for (long step = 0; step < steps; ++step) {
      double done = 0;  // of the step: one that is not found is cut in halves
      double stride = 1;
      int halvings = 0;
      while (done < 1) {
        if (steppers_[actor]->step((static_cast<double>(step) + done) * dt, stride * dt)) {
          done += stride;
          continue;
        }
        ++halvings_;
        stride /= 2;
        if (++halvings > kMostHalvings) {
          throw Diverged(
              actor, fmt::format("body {}: no step of {:.3g} s leads on from t = {:.6g} s; use more bricks, a stiffer "
                                 "material or a shorter fall",
                                 actor + 1, stride * dt, time + dt * (static_cast<double>(step) + done)));
        }
      }
    }
  }
  move_obstacles(world_.obstacles, dt * static_cast<double>(steps));
}

void ImplicitMotion::pass(MotionMemory& memory) {
  for (const auto& stepper : steppers_) stepper->pass(memory);
}

ImplicitMotion::Report ImplicitMotion::report() const {
  Report report;
  report.halvings = halvings_;
  for (const auto& stepper : steppers_) {
    const SolveReport solves = stepper->solves();
    report.solves.solves += solves.solves;
    report.solves.iterations += solves.iterations;
    report.solves.most = std::max(report.solves.most, solves.most);
    report.solves.indefinite += solves.indefinite;
    report.solves.gone_direct += solves.gone_direct;
    report.steps += stepper->steps();
    report.newton_iterations += stepper->iterations();
  }
  return report;
}

}  // namespace sprung
