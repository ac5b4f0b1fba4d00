#include "core/bricks/shell_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace sprung {
namespace {

constexpr int kSamples = 4;  // along a cell's side; the 64 of a cell are the bits of a number
constexpr std::uint64_t kAll = ~std::uint64_t{0};

using Corners = std::array<Vec3, 3>;

double squared_distance_to_side(const Vec3& a, const Vec3& b, const Vec3& place) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((place - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + share * along - place).squaredNorm();
}

/// A triangle, ready to be asked how far places are.
class Triangle {
 public:
  explicit Triangle(const Corners& corners) : corners_(corners) {
    normal_ = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (normal_.norm() > 0) normal_.normalize();
  }

  [[nodiscard]] double squared_distance(const Vec3& place) const {
    if (is_above(place)) {
      const double height = normal_.dot(place - corners_[0]);
      return height * height;
    }
    return std::min({squared_distance_to_side(corners_[0], corners_[1], place),
                     squared_distance_to_side(corners_[1], corners_[2], place),
                     squared_distance_to_side(corners_[2], corners_[0], place)});
  }

 private:
  [[nodiscard]] bool is_above(const Vec3& place) const {
    if (normal_.isZero(0)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = corners_[(k + 1) % 3] - corners_[k];
      if (normal_.cross(side).dot(place - corners_[k]) < 0) return false;
    }
    return true;
  }

  Corners corners_;
  Vec3 normal_;
};

/// The samples of a cell that lie within `reach` of the triangle, with those known already.
std::uint64_t near_samples(const Triangle& triangle, const Vec3& low, double reach, std::uint64_t known) {
  if (known == kAll) return known;
  const double half_diagonal = std::sqrt(3.0) / 2;
  const double middle = std::sqrt(triangle.squared_distance(low.array() + 0.5));
  if (middle > reach + half_diagonal) return known;
  if (middle < reach - half_diagonal) return kAll;
  for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((known & bit) != 0) continue;
    const Eigen::Array3i place(i % kSamples, i / kSamples % kSamples, i / (kSamples * kSamples));
    if (triangle.squared_distance(low.array() + (place.cast<double>() + 0.5) / kSamples) <= reach * reach) known |= bit;
  }
  return known;
}

}  // namespace

void fill_shell(const CellSurface& surface, double thickness, CellSums& sums) {
  // A little more than half, so that samples in line with a face of the shell do not depend on rounding.
  constexpr double kMargin = 1e-6;
  const double sampled = std::max(1.0, thickness);
  const double reach = sampled / 2 + kMargin;
  std::vector<std::uint64_t> samples(sums.weight.size(), 0);
  for (const auto& row : surface.triangles.rowwise()) {
    const Corners corners{surface.points.row(row[0]), surface.points.row(row[1]), surface.points.row(row[2])};
    const Triangle triangle(corners);
    const Vec3 lowest = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).array() - reach;
    const Vec3 highest = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]).array() + reach;
    const Eigen::Array3i low = lowest.array().floor().cast<int>().max(0);
    const Eigen::Array3i high = (highest.array().floor().cast<int>() + 1).min(surface.counts.array());
    for (int z = low.z(); z < high.z(); ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x) {
          const auto cell = static_cast<std::size_t>(x) +
                            static_cast<std::size_t>(surface.counts.x()) *
                                (static_cast<std::size_t>(y) +
                                 static_cast<std::size_t>(surface.counts.y()) * static_cast<std::size_t>(z));
          samples[cell] = near_samples(triangle, Vec3(x, y, z), reach, samples[cell]);
        }
      }
    }
  }
  const double share = thickness / sampled / (kSamples * kSamples * kSamples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sums.weight[i] = 1;
    sums.weighted[i] = static_cast<float>(share * std::popcount(samples[i]));
  }
}

}  // namespace sprung
