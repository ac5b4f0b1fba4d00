#pragma once

namespace sprung::test {

struct SpringRows;

/// The peak performance of this machine, measured on the spot, with a number of threads.
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

/// The loops for the instruction set that the kernels use.
[[nodiscard]] LimitLoops best_loops();

inline constexpr int kChains = 10;  // enough to hide the latency of an operation, few enough for the registers

}  // namespace sprung::test
