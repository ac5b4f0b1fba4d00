#include "render/trace/irradiance_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr float kHalfTurn = std::numbers::pi_v<float>;
constexpr int kElevations = 21;  // from straight down to straight up
constexpr int kAzimuths = 32;
constexpr int kTableSide = 24;  // directions for each of them, along the sides of a square

Vector3f normal_at(int elevation, int turn) {
  const float up = kHalfTurn * (float(elevation) / (kElevations - 1) - 0.5F);
  const float around = 2 * kHalfTurn * float(turn) / kAzimuths;
  return {std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around)};
}

}  // namespace

IrradianceTable::IrradianceTable(const StageLight& light) {
  values_.reserve(std::size_t(kElevations) * kAzimuths);
  for (int i = 0; i < kElevations * kAzimuths; ++i) {
    values_.push_back(light.from_around(normal_at(i / kAzimuths, i % kAzimuths), kTableSide));
  }
}

Vector3f IrradianceTable::on(const Vector3f& normal) const {
  const float row = (std::asin(std::clamp(normal.y(), -1.0F, 1.0F)) / kHalfTurn + 0.5F) * (kElevations - 1);
  const float column = (std::atan2(normal.z(), normal.x()) / (2 * kHalfTurn) + 1) * kAzimuths;
  const int low = std::clamp(int(row), 0, kElevations - 2);
  const int left = int(column);
  const auto value = [&](int up, int along) {
    return values_[std::size_t(low + up) * kAzimuths + (left + along) % kAzimuths];
  };
  const float up = row - float(low);
  const float along = column - float(left);
  return (1 - up) * ((1 - along) * value(0, 0) + along * value(0, 1)) +
         up * ((1 - along) * value(1, 0) + along * value(1, 1));
}

}  // namespace sprung
