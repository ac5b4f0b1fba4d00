#pragma once

namespace sprung::test {

struct SpringRows;

/// What this machine does at most, measured on the spot, by a number of threads together.
struct MachineLimits {
  double bandwidth = 0;   // bytes/s, two arrays read and one written, far beyond the caches
  double operations = 0;  // additions and multiplications in double a second, as many of each, not fused
  double roots = 0;       // pairs of a square root and a division in double a second
};

[[nodiscard]] MachineLimits measure_limits(int threads);

/// Loops for one instruction set. Two do nothing but one kind of operation, `rounds` times on kChains packs side by
/// side, and return what they computed.
struct LimitLoops {
  int lanes = 0;
  double (*operations)(long rounds) = nullptr;  // an addition and a multiplication
  double (*roots)(long rounds) = nullptr;       // a square root and a division
  void (*rows)(SpringRows& rows, double dt) = nullptr;
};

/// For the instructions that the kernels use.
[[nodiscard]] LimitLoops best_loops();

inline constexpr int kChains = 10;  // enough to hide what one operation takes, few enough for the registers

}  // namespace sprung::test
