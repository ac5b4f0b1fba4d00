#include "render/stage/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {
namespace {

using Eigen::Vector3f;

}  // namespace

Vector3f direction_of(const Panorama& panorama, int x, int y) {
  const double around = 2 * std::numbers::pi * ((x + 0.5) / panorama.width - 0.5);
  const double down = std::numbers::pi * (y + 0.5) / panorama.height;
  return Eigen::Vector3d(std::sin(down) * std::sin(around), std::cos(down), -std::sin(down) * std::cos(around))
      .cast<float>();
}

double solid_angle(const Panorama& panorama, int y) {
  const double top = std::cos(std::numbers::pi * y / panorama.height);
  const double bottom = std::cos(std::numbers::pi * (y + 1) / panorama.height);
  return (top - bottom) * 2 * std::numbers::pi / panorama.width;
}

Vector3f looked_up(const Panorama& panorama, const Vector3f& direction) {
  constexpr auto kHalfTurn = std::numbers::pi_v<float>;
  const float x = (0.5F + std::atan2(direction.x(), -direction.z()) / (2 * kHalfTurn)) * float(panorama.width) - 0.5F;
  const float y = std::acos(std::clamp(direction.y(), -1.0F, 1.0F)) / kHalfTurn * float(panorama.height) - 0.5F;
  const int left = int(std::floor(x));
  const int top = int(std::floor(y));
  const auto at = [&](int column, int row) -> Vector3f {
    const int wrapped = (column % panorama.width + panorama.width) % panorama.width;
    return panorama.light[texel(panorama, wrapped, std::clamp(row, 0, panorama.height - 1))];
  };
  const float across = x - float(left);
  const float down = y - float(top);
  const Vector3f above = at(left, top) + across * (at(left + 1, top) - at(left, top));
  const Vector3f below = at(left, top + 1) + across * (at(left + 1, top + 1) - at(left, top + 1));
  return above + down * (below - above);
}

Panorama turned(const Panorama& panorama, double degrees) {
  const double columns = degrees / 360 * panorama.width;  // azimuths grow to the left
  const double whole = std::floor(columns);
  const auto part = float(columns - whole);
  Panorama result = panorama;
  for (int x = 0; x < panorama.width; ++x) {
    const double from = std::fmod(x + whole, panorama.width);
    const int left = int(from < 0 ? from + panorama.width : from);
    const int right = (left + 1) % panorama.width;
    for (int y = 0; y < panorama.height; ++y) {
      const Vector3f& one = panorama.light[texel(panorama, left, y)];
      result.light[texel(result, x, y)] = one + part * (panorama.light[texel(panorama, right, y)] - one);
    }
  }
  return result;
}

Panorama no_wider_than(const Panorama& panorama, int width) {
  const int square = (panorama.width + width - 1) / width;
  if (square <= 1) return panorama;
  Panorama result{panorama.width / square, panorama.height / square, {}};
  result.light.resize(std::size_t(result.width) * std::size_t(result.height), Vector3f::Zero());
  for (int y = 0; y < square * result.height; ++y) {
    for (int x = 0; x < square * result.width; ++x) {
      result.light[texel(result, x / square, y / square)] += panorama.light[texel(panorama, x, y)] / (square * square);
    }
  }
  return result;
}

}  // namespace sprung
