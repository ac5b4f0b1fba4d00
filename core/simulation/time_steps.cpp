#include "core/simulation/time_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/implicit/implicit_motion.h"
#include "core/error.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr double kManySteps = 20000;  // per frame, from which on there is a warning
// Cost of an implicit step, in explicit steps.
constexpr double kFreeCost = 200;       // of bodies without contact, or hanging
constexpr double kObstacleCost = 500;   // of those that may come to lie on obstacles
constexpr double kCoupledCost = 1000;   // of bodies that may collide or are glued
constexpr double kNodesPerBrick = 1.4;  // of the compact bodies that these are of; thin ones have up to 4
constexpr double kStepsAVibration = 20;
constexpr long kFewestSteps = 2;  // implicit steps per frame
constexpr long kMaxSteps = 16;
constexpr double kWorthwhile = 2;  // times faster, to accept the numerical damping of implicit steps

/// s; of the slowest vibrations of all bodies.
double shortest_period(const World& world) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const SoftBody& body : world.bodies) {
    shortest = std::min(shortest, 1 / slowest_frequency(body.material, length_of(body)));
  }
  return shortest;
}

long implicit_steps(const World& world, double frame) {
  const double wanted = std::ceil(frame * kStepsAVibration / shortest_period(world));
  return std::clamp(long(std::min(wanted, 1e6)), kFewestSteps, kMaxSteps);
}

/// How much more an implicit step costs where bodies are thin: Newton's method and multigrid then need several times
/// the iterations.
double thinness_cost(const World& world) {
  double nodes = 0;
  double bricks = 0;
  for (const SoftBody& body : world.bodies) {
    nodes += body.node_count();
    bricks += body.grid.brick_count();
  }
  const double thinness = nodes / (kNodesPerBrick * std::max(bricks, 1.0));
  return std::max(1.0, thinness * thinness);
}

double contact_cost(const World& world) {
  if (!world.glue.empty() || (world.bodies_collide && world.bodies.size() > 1)) return kCoupledCost;
  const auto is_held = [](const SoftBody& body) { return !body.pinned.empty() || !body.foundations.empty(); };
  const bool is_free = world.obstacles.empty() || std::all_of(world.bodies.begin(), world.bodies.end(), is_held);
  return is_free ? kFreeCost : kObstacleCost;
}

double implicit_cost(const World& world) { return contact_cost(world) * thinness_cost(world); }

}  // namespace

std::string_view remedy_for(const StepPlan& plan) {
  if (plan.is_implicit()) return "fewer bricks or a shorter --duration make it quicker";
  return "fewer bricks, a softer material, a shorter --duration or, for stiff bodies, --integrator auto make it "
         "quicker";
}

std::string warning_of(const StepPlan& plan) {
  if (double(plan.steps.count) < kManySteps) return "";
  return fmt::format("a frame takes {} steps of {}, because bricks are stiff and small or something moves fast; {}",
                     plan.steps.count, readable(plan.steps.dt, Dimension::kTime), remedy_for(plan));
}

StepPlan plan_steps(const World& world, const Scene& scene) {
  const double frame = 1 / scene.fps;
  Steps short_ones{.count = 0, .dt = 0};
  double bricks = 0;
  double brick_steps = 0;
  for (const GroupSteps& group : choose_steps(world, frame)) {
    for (const std::size_t i : group.bodies) {
      const int count = world.bodies[i].grid.brick_count();
      bricks += count;
      brick_steps += count * double(group.steps.count);
    }
    if (group.steps.count > short_ones.count) short_ones = group.steps;
  }
  const long long_ones = implicit_steps(world, frame);
  StepPlan plan;
  plan.scheme = scene.solver.scheme;
  const std::string why_not = check_implicit_support(world);
  if (plan.is_implicit() && !why_not.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}, which needs explicit steps: solver.scheme euler or verlet, or "
                                                  "auto, which then takes them",
                                                  why_not));
  }
  if (plan.scheme == Solver::kAuto) {
    const double step_cost = implicit_cost(world) * double(long_ones);
    const bool is_implicit = why_not.empty() && brick_steps > kWorthwhile * step_cost * bricks;
    plan.scheme = is_implicit ? Solver::kBdf2 : Solver::kEuler;
    plan.reason = fmt::format(
        "{}: {} explicit steps a frame against {} implicit ones, which take as long as about "
        "{:.0f} explicit ones{}",
        is_implicit ? "bdf2" : "euler", std::lround(brick_steps / bricks), long_ones, step_cost,
        why_not.empty() ? "" : fmt::format("; {}, which needs explicit ones", why_not));
  }
  plan.steps = short_ones;
  plan.brick_steps = brick_steps;
  if (plan.is_implicit()) {
    plan.steps = {.count = long_ones, .dt = frame / double(long_ones)};
    plan.brick_steps = bricks * double(long_ones);
  }
  return plan;
}

}  // namespace sprung
