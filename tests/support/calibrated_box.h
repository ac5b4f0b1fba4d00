#pragma once
#include <cmath>

#include "core/dynamics/explicit/integrator.h"
#include "tests/support/bodies.h"

namespace sprung::test {

/// A box of the calibrated model; h in m, young in Pa.
inline Body calibrated_box(const Eigen::Vector3i& counts, double h, double poisson, double young = 1e4) {
  return make_body(make_box_grid(counts, h), Model::kSprings, test_material(poisson, young));
}

/// Advances by as few equal explicit steps as are stable at the start; duration in s.
inline void advance_by_stable_steps(World& world, Scheme scheme, double duration) {
  const auto steps = long(std::ceil(duration / stable_step(world)));
  advance(world, scheme, duration / double(steps), steps, 0);
}

}  // namespace sprung::test
