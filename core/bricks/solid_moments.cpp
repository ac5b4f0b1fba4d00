#include "core/bricks/solid_moments.h"

#include <algorithm>

#include "core/bricks/brick_grid.h"
#include "core/bricks/solid_samples.h"

namespace sprung {
namespace {

constexpr double kOwnAxis = 64;     // weight along a direction's lines, relative to across them
constexpr double kMinTrust = 1e-6;  // decides where no line crosses the surface

}  // namespace

SolidIntegrals& SolidIntegrals::operator+=(const SolidIntegrals& other) {
  volume += other.volume;
  first += other.first;
  second += other.second;
  return *this;
}

SolidIntegrals SolidIntegrals::moved(const Vec3& by) const {
  SolidIntegrals result = *this;
  result.first += volume * by;
  result.second += first * by.transpose() + by * first.transpose() + volume * by * by.transpose();
  return result;
}

SolidMoments SolidIntegrals::moments() const {
  const Vec3 centroid = first / volume;
  return {.centroid = centroid, .covariance = second / volume - centroid * centroid.transpose()};
}

SolidIntegrals integrals_of(double volume, const SolidMoments& moments) {
  const SolidIntegrals about_centroid{.volume = volume, .second = volume * moments.covariance};
  return about_centroid.moved(moments.centroid);
}

void LineIntegrals::add(int axis, const Vec3& line, double low, double high, int ends) {
  Direction& direction = directions_[axis];
  const double length = high - low;
  SolidMoments moments{.centroid = line, .covariance = Mat3::Identity() * (kSamplePitch * kSamplePitch / 12)};
  moments.centroid[axis] = (low + high) / 2;
  moments.covariance(axis, axis) = length * length / 12;
  direction.integrals += integrals_of(length * kSamplePitch * kSamplePitch, moments);
  direction.ends += ends;
}

SolidIntegrals LineIntegrals::best(double volume) const {
  Vec3 centroid_sum = Vec3::Zero();
  Vec3 centroid_trust = Vec3::Zero();
  Mat3 covariance_sum = Mat3::Zero();
  Mat3 covariance_trust = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Direction& direction = directions_[axis];
    if (direction.integrals.volume <= 0) continue;
    const SolidMoments moments = direction.integrals.moments();
    const double trust = double(direction.ends) * direction.ends + kMinTrust;
    Vec3 along = Vec3::Constant(trust);
    along[axis] *= kOwnAxis;
    const Mat3 both = (along * along.transpose()).cwiseSqrt();
    centroid_sum += along.cwiseProduct(moments.centroid);
    centroid_trust += along;
    covariance_sum += both.cwiseProduct(moments.covariance);
    covariance_trust += both;
  }
  if (centroid_trust.isZero()) return integrals_of(volume, {});
  return integrals_of(volume, {.centroid = centroid_sum.cwiseQuotient(centroid_trust),
                               .covariance = covariance_sum.cwiseQuotient(covariance_trust)});
}

std::vector<SolidMoments> solid_moments(const BrickGrid& grid) {
  std::vector<SolidIntegrals> sums(grid.cells.size());
  std::vector<bool> is_cut(grid.cells.size(), false);
  for (const SolidPatch& patch : grid.patches) {
    const Eigen::Vector3i offset = patch.cell - grid.cells[patch.brick];
    sums[patch.brick] += patch.solid.moved(offset.cast<double>());
    if (offset.isZero()) is_cut[patch.brick] = true;
  }
  std::vector<SolidMoments> moments;
  moments.reserve(sums.size());
  for (std::size_t brick = 0; brick < sums.size(); ++brick) {
    if (!is_cut[brick]) sums[brick] += integrals_of(1, {});
    moments.push_back(sums[brick].moments());
  }
  return moments;
}

}  // namespace sprung
