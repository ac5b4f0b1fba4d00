#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace sprung {

/// Numbers in [0, 1) for one sample of a pixel. Over a pixel's samples each pair is a Sobol sequence, scrambled for
/// that pixel and that pair: B. Burley, "Practical Hash-based Owen Scrambling" (2020). The same in every run.
class Sampler {
 public:
  Sampler(std::uint32_t pixel, std::uint32_t sample) : seed_(hashed(pixel + 1)), sample_(sample) {}

  [[nodiscard]] Eigen::Vector2f pair();
  [[nodiscard]] float number() { return pair().x(); }

 private:
  [[nodiscard]] static std::uint32_t hashed(std::uint32_t value);

  std::uint32_t seed_;
  std::uint32_t sample_;
  std::uint32_t drawn_ = 0;
};

}  // namespace sprung
