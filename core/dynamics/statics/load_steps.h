#pragma once
#include <algorithm>

#include "core/dynamics/statics/statics.h"

namespace sprung {

/// Raises a load from none to all of it, by steps that double after each success and halve after each failure.
/// `solve(share)`: moves to the equilibrium under this share of the load; where it returns false, the state must be as
/// before. Counts the steps in `report`. Returns the share reached: below 1 if a step was shorter than
/// StaticOptions allow, or all steps took too many iterations.
template <class Solve>
double raise_load(const StaticOptions& options, StaticReport& report, const Solve& solve) {
  double done = 0;
  double step = 1;
  report.load_steps = 0;
  while (done < 1) {
    const double share = std::min(1.0, done + step);
    if (solve(share)) {
      done = share;
      ++report.load_steps;
      step *= 2;
      continue;
    }
    step = std::min(step, share - done) / 2;
    if (step * options.max_load_steps < 1 || report.iterations >= options.max_iterations_in_all) break;
  }
  return done;
}

}  // namespace sprung
