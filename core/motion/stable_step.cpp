#include "core/motion/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/brick_columns.h"
#include "core/body/brick_hessian.h"
#include "core/motion/implicit_damping.h"

namespace sprung {
namespace {

/// What the volume guard can add to a brick's stiffness, in units of guard / h^2: the squared gradient of the volume
/// ratio of a brick pressed flat to the guard's threshold along one axis.
constexpr double kGuardGradient = 0.6;
constexpr double kGuardAreas = 1.18;   // of that brick: the sum of its three faces' squared areas, in h^4
constexpr double kMayBePressed = 0.6;  // bricks with less than that share of their volume may soon feel the guard

/// How many times that gradient, squared, a brick has by now that is pressed one way and drawn out another.
double guard_growth(const Body& body) {
  const double h = body.grid.brick_size;
  double largest = kGuardAreas;
  for (const auto& nodes : body.grid.nodes) {
    const Mat3 axes = mean_axes_of(columns_of(nodes, body.positions));
    const Mat3 areas = areas_of(axes) / (h * h);
    if (axes.col(0).dot(areas.col(0)) < kMayBePressed * h) largest = std::max(largest, areas.squaredNorm());
  }
  return largest / kGuardAreas;
}

}  // namespace

double largest_frequency_squared(const Body& body) {
  const double h = body.grid.brick_size;
  const double guard = kGuardGradient * guard_growth(body) * body.law.guard / (h * h);
  const double stiffness = largest_brick_stiffness(body) + guard;
  double share = 0;
  for (const double scale : body.stiffness_scale) share += scale;
  const double corner_mass = body.masses.sum() / share / 8;
  return stiffness / corner_mass;
}

/// Leapfrog with damping c = alpha + beta omega^2 is stable while omega^2 dt^2 + 2 c dt < 4.
double stable_step(const Body& body, double safety) {
  const double squared = largest_frequency_squared(body);
  const Rayleigh ours = damping_shares(body, squared).explicit_part;
  const double damping = ours.alpha + ours.beta * squared;
  return safety * 4 / (damping + std::sqrt(damping * damping + 4 * squared));
}

double stable_step(const World& world, double safety) {
  double step = std::numeric_limits<double>::infinity();
  for (const Actor& actor : world.actors) step = std::min(step, stable_step(actor.body, safety));
  return step;
}

}  // namespace sprung
