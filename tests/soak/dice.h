#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "core/types.h"

namespace sprung::test {

/// std::uniform_real_distribution may differ between libraries; this does not.
class Dice {
 public:
  Dice(std::uint32_t seed, std::uint32_t index) : engine_(seed * 1000003U + index) {}
  double between(double low, double high) { return low + (high - low) * (double(engine_()) / 4294967296.0); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int whole(int low, int high) { return low + int(engine_() % unsigned(high - low + 1)); }
  bool is_so(double probability) { return between(0, 1) < probability; }
  Mat3 rotation() {
    const auto angle = [&] { return between(0, 2 * std::numbers::pi); };
    return (Eigen::AngleAxisd(angle(), Vec3::UnitX()) * Eigen::AngleAxisd(angle(), Vec3::UnitY()) *
            Eigen::AngleAxisd(angle(), Vec3::UnitZ()))
        .toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace sprung::test
