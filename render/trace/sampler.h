#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace sprung {

/// Numbers in [0, 1) for one sample of a picture. Samples with successive numbers fill the unit square of each pair
/// evenly: every aligned 16, say, as one set, and every aligned 256 as another. Each pair is one of some Sobol
/// sequences, shuffled and scrambled after B. Burley, "Practical Hash-based Owen Scrambling" (2020), with bits flipped
/// by that pair and after every 4096 samples. The same in every run.
class Sampler {
 public:
  explicit Sampler(std::uint64_t number);
  /// A sampler for one of the samples of a pixel. Pixels are numbered along a Z-shaped curve, so that those of a
  /// neighbourhood, which are smoothed together, also sample evenly together: A. Ahmed and P. Wonka, "Screen-Space
  /// Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels" (2020).
  Sampler(int x, int y, int sample, int samples);

  [[nodiscard]] Eigen::Vector2f pair();
  [[nodiscard]] float number() { return pair().x(); }

 private:
  std::uint32_t seed_;
  std::uint32_t sample_;
  std::uint32_t drawn_ = 0;
};

}  // namespace sprung
