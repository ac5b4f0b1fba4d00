#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace sprung {

/// Numbers in [0, 1) for one sample of a pixel. Over a pixel's samples each pair is one of some Sobol sequences,
/// shuffled and scrambled after B. Burley, "Practical Hash-based Owen Scrambling" (2020), with bits flipped for that
/// pixel and that pair. The same in every run.
class Sampler {
 public:
  Sampler(std::uint32_t pixel, std::uint32_t sample);

  [[nodiscard]] Eigen::Vector2f pair();
  [[nodiscard]] float number() { return pair().x(); }

 private:
  std::uint32_t seed_;
  std::uint32_t sample_;
  std::uint32_t drawn_ = 0;
};

}  // namespace sprung
