#pragma once
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "tests/support/bodies.h"

namespace sprung::test {

/// A box of the calibrated model; h in m, young in Pa.
inline Body calibrated_box(const Eigen::Vector3i& counts, double h, double poisson, double young = 1e4) {
  return make_body(make_box_grid(counts, h), Model::kCalibrated, test_material(poisson, young));
}

/// Advances by explicit steps that are stable; duration in s.
inline void advance_by_stable_steps(World& world, Scheme scheme, double duration) {
  constexpr int kFrames = 20;
  AdaptiveIntegrator motion(world, scheme);
  for (int frame = 0; frame < kFrames; ++frame) {
    static_cast<void>(motion.advance_frame(
        duration * frame / kFrames, duration / kFrames, [](double) {}, [](const std::string&) {}));
  }
}

}  // namespace sprung::test
