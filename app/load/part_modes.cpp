#include "app/load/part_modes.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/dynamics/statics/buckling.h"
#include "core/dynamics/statics/modes.h"
#include "core/error.h"
#include "core/simulation/drivers.h"
#include "core/text.h"

namespace sprung {
namespace {

const SoftBody& only_body(const PartSolution& solution) {
  const std::vector<SoftBody>& bodies = solution.simulation.world.bodies;
  if (bodies.size() == 1) return bodies[0];
  throw Error(ErrorKind::kBadInput,
              "--modes and --buckling are of one body, and this part has several solids that are not joined");
}

/// The coarser grids, the finer one first; the only one if there is no coarser one.
std::vector<const PartSolution*> coarser(const std::vector<PartSolution>& solutions) {
  std::vector<const PartSolution*> some;
  for (std::size_t grid = solutions.size() > 1 ? 1 : 0; grid < solutions.size(); ++grid)
    some.push_back(&solutions[grid]);
  return some;
}

/// The estimate from the last of the coarser grids.
Estimate estimate_of(double fine, double coarse, const std::vector<const PartSolution*>& grids) {
  if (grids.size() == 1) return {.value = fine, .error = std::numeric_limits<double>::infinity()};
  return {.value = fine,
          .error = convergence_index(fine, coarse, grids.back()->brick_size / grids.front()->brick_size)};
}

}  // namespace

std::vector<Estimate> frequencies_of(const std::vector<PartSolution>& solutions, int count, const Observer& observer) {
  const std::vector<const PartSolution*> grids = coarser(solutions);
  Progress progress(observer, "modes", double(grids.size()));
  std::vector<Eigen::VectorXd> found;
  for (const PartSolution* grid : grids) {
    Body body = only_body(*grid);
    body.positions = body.rest_positions;
    const Supports supports = supports_of(only_body(*grid));
    found.push_back(natural_modes(body, supports, count, [&] { observer.check_interrupt(); }).frequencies);
    progress.update(double(found.size()));
  }
  progress.finish(fmt::format("{} of {} bricks", count_of(count, "mode"), grids.front()->brick_count()));
  std::vector<Estimate> frequencies;
  frequencies.reserve(std::size_t(count));
  for (int mode = 0; mode < count; ++mode) {
    frequencies.push_back(estimate_of(found.front()[mode], found.back()[mode], grids));
  }
  return frequencies;
}

std::optional<Estimate> buckling_factor_of(const std::vector<PartSolution>& solutions, const Observer& observer) {
  const std::vector<const PartSolution*> grids = coarser(solutions);
  Progress progress(observer, "buckling", double(grids.size()));
  std::vector<double> factors;
  for (const PartSolution* grid : grids) {
    const SoftBody& body = only_body(*grid);
    if (!grid->is_linear) {
      throw Error(ErrorKind::kBadInput, "--buckling starts from small displacements, not from --analysis nonlinear");
    }
    const StressTensors stresses = recover_stress(body, body.positions, StrainMeasure::kSmall);
    const BucklingModes modes =
        find_buckling(body, supports_of(body), stresses, 1, [&] { observer.check_interrupt(); });
    if (modes.factors.size() == 0) return std::nullopt;
    factors.push_back(modes.factors[0]);
    progress.update(double(factors.size()));
  }
  progress.finish(fmt::format("{} bricks", grids.front()->brick_count()));
  return estimate_of(factors.front(), factors.back(), grids);
}

}  // namespace sprung
