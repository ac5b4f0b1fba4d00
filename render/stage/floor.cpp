#include "render/stage/floor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/appearance.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

/// A hash from 0 up to 1.
float hashed(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = x * 0x9e3779b1U ^ y * 0x85ebca77U ^ seed * 0xc2b2ae3dU;
  h = (h ^ (h >> 15)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12)) * 0x297a2d39U;
  return float((h ^ (h >> 15)) >> 8) / float(1 << 24);
}

/// Smooth noise from 0 to 1 that repeats after `period` units along x.
float noise(float x, float y, int period, std::uint32_t seed) {
  const int left = int(std::floor(x));
  const int low = int(std::floor(y));
  const auto eased = [](float t) { return t * t * (3 - 2 * t); };
  const float across = eased(x - float(left));
  const auto at = [&](int i, int j) { return hashed(std::uint32_t(i % period), std::uint32_t(j), seed); };
  const float below = std::lerp(at(left, low), at(left + 1, low), across);
  const float above = std::lerp(at(left, low + 1), at(left + 1, low + 1), across);
  return std::lerp(below, above, eased(y - float(low)));
}

/// Linear light of sRGB bytes.
const std::array<float, 256>& linear_bytes() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(float(i) / 255);
    return values;
  }();
  return table;
}

/// `albedo_at` of the middle of a texel, 0 to 1 along each side.
template <class AlbedoAt>
FloorPattern painted(int width, int height, const Eigen::Vector2d& sides, const AlbedoAt& albedo_at) {
  FloorPattern pattern{width, height, sides, {}, Vector3f::Zero()};
  pattern.rgba.reserve(4 * std::size_t(width) * std::size_t(height));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Vector3f albedo = albedo_at((float(column) + 0.5F) / float(width), (float(row) + 0.5F) / float(height));
      for (int k = 0; k < 3; ++k) {
        pattern.rgba.push_back(std::uint8_t(std::lround(255 * srgb_from_linear(albedo[k]))));
        sum[k] += double{linear_bytes()[pattern.rgba.back()]};
      }
      pattern.rgba.push_back(255);
    }
  }
  pattern.mean = (sum / (double(width) * height)).cast<float>();
  return pattern;
}

FloorPattern checker(double side) {
  const Vector3f light(0.78F, 0.765F, 0.745F);
  const Vector3f dark(0.47F, 0.465F, 0.46F);
  return painted(512, 512, {2 * side, 2 * side},
                 [&](float x, float y) { return (x < 0.5F) == (y < 0.5F) ? light : dark; });
}

constexpr int kRows = 8;         // of boards
constexpr float kLength = 12;    // over which a row repeats, in widths of a board; two boards
constexpr float kJoint = 0.02F;  // in widths of a board

/// Oiled oak: rows of boards of several browns, with a grain along them and dark joints between them.
Vector3f wood_at(float x, float y) {
  const Vector3f pale(0.60F, 0.43F, 0.26F);
  const Vector3f brown(0.38F, 0.235F, 0.12F);
  const float across = y * kRows;
  const auto row = std::uint32_t(across);
  const float shifted = x * kLength + kLength * hashed(row, 7, 1);  // the joints of the rows are staggered
  const float along = shifted - kLength * std::floor(shifted / kLength);
  const auto board = 2 * row + (along < kLength / 2 ? 0U : 1U);
  const float in_row = across - float(row);
  const float from_end = std::min(std::fmod(along, kLength / 2), kLength / 2 - std::fmod(along, kLength / 2));
  const float joint = std::min({in_row, 1 - in_row, from_end});

  const float fine = noise(along * 6, in_row * 90, 72, 100 + board);
  const float streak = noise(along * 1.5F, in_row * 26, 18, 200 + board);
  const float wave = noise(along * 0.5F, in_row * 4, 6, 300 + board);
  const float rings = 0.5F + 0.5F * std::sin(6.2832F * (in_row * 7 + 3 * wave));
  const float dark = 0.42F * hashed(board, 3, 2) + 0.20F * fine + 0.22F * streak + 0.16F * rings;
  const Vector3f wood = pale + dark * (brown - pale);
  return wood * (joint < kJoint ? 0.45F + 0.55F * joint / kJoint : 1.0F);
}

FloorPattern boards(double width) { return painted(1536, 1024, {kLength * width, kRows * width}, wood_at); }

}  // namespace

Vector3f FloorPattern::albedo(double x, double z) const {
  const auto wrapped = [](int i, int count) { return (i % count + count) % count; };
  const double u = x / sides.x() * width - 0.5;
  const double v = z / sides.y() * height - 0.5;
  const int left = int(std::floor(u));
  const int low = int(std::floor(v));
  const auto at = [&](int column, int row) -> Vector3f {
    const std::uint8_t* bytes = &rgba[4 * (std::size_t(wrapped(row, height)) * width + wrapped(column, width))];
    return {linear_bytes()[bytes[0]], linear_bytes()[bytes[1]], linear_bytes()[bytes[2]]};
  };
  const auto across = float(u - left);
  const auto up = float(v - low);
  return (1 - up) * ((1 - across) * at(left, low) + across * at(left + 1, low)) +
         up * ((1 - across) * at(left, low + 1) + across * at(left + 1, low + 1));
}

Eigen::Vector2f Floor::end() const {
  return has_horizon ? Eigen::Vector2f(-0.12F, 0) : Eigen::Vector2f(-0.45F, -0.02F);
}

Floor floor_of(FloorKind kind, double size) {
  Floor floor{.has_horizon = kind != FloorKind::kSweep && kind != FloorKind::kNone};
  if (kind == FloorKind::kChecker) floor.pattern = std::make_shared<const FloorPattern>(checker(size));
  if (kind == FloorKind::kWood) floor.pattern = std::make_shared<const FloorPattern>(boards(size));
  return floor;
}

}  // namespace sprung
