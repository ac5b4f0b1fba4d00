#include "core/law/solid/strain_differences.h"

#include <algorithm>

#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

/// Edges, then face diagonals.
CornerPair spring(int number) { return number < 12 ? kEdges[number] : kFaceDiagonals[number - 12]; }

}  // namespace

StrainDifferences::StrainDifferences(double h, const Vec3& centroid) {
  modes_.setZero();
  const double per_square = 1 / (2 * h * h * h);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (int side = 0; side < 4; ++side) {
      const double in_j = edge_sign(side, 0);
      const double in_k = edge_sign(side, 1);
      const int edge = 4 * i + side;
      modes_(row_of(i, j), edge) = per_square * in_j * (0.5 + in_k * centroid[k]);
      modes_(row_of(i, k), edge) = per_square * in_k * (0.5 + in_j * centroid[j]);
      modes_(9 + i, edge) = per_square * in_j * in_k / h;
    }
    for (int side = 0; side < 2; ++side) {
      const int diagonal = 12 + 4 * i + 2 * side;
      const double sign = (side != 0 ? 1 : -1) * per_square / 2;
      modes_(6 + i, diagonal) = sign;
      modes_(6 + i, diagonal + 1) = -sign;
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (k != i) modes_.row(6 + k) += h * centroid[i] * modes_.row(9 + i);
    }
  }
}

StrainDifferences::Values StrainDifferences::values(const BrickVector& x) const {
  return modes_ * ways(x).colwise().squaredNorm().transpose();
}

StrainDifferences::Rates StrainDifferences::rates(const BrickVector& x) const {
  const Ways d = ways(x);
  Rates rates = Rates::Zero();
  for (int number = 0; number < kSprings; ++number) {
    const auto [from, to] = spring(number);
    const Eigen::Matrix<double, kAll, 3> rate = 2 * modes_.col(number) * d.col(number).transpose();
    rates.middleCols<3>(3 * from) -= rate;
    rates.middleCols<3>(3 * to) += rate;
  }
  return rates;
}

StrainDifferences::Values StrainDifferences::change(const BrickVector& x, const BrickVector& v) const {
  return 2 * (modes_ * ways(x).cwiseProduct(ways(v)).colwise().sum().transpose());
}

BrickVector StrainDifferences::pull(const BrickVector& x, const Values& force) const {
  const Ways d = ways(x);
  const Springs tension = 2 * (modes_.transpose() * force);
  BrickVector pull = BrickVector::Zero();
  for (int number = 0; number < kSprings; ++number) {
    const auto [from, to] = spring(number);
    const Vec3 along = tension[number] * d.col(number);
    pull.segment<3>(3 * from) -= along;
    pull.segment<3>(3 * to) += along;
  }
  return pull;
}

void StrainDifferences::add_curvature(const Values& force, bool definite, BrickMatrix& matrix) const {
  const Springs tension = 2 * (modes_.transpose() * force);
  for (int number = 0; number < kSprings; ++number) {
    const double sideways = definite ? std::max(tension[number], 0.0) : tension[number];
    const auto [from, to] = spring(number);
    for (int k = 0; k < 3; ++k) {
      matrix(3 * from + k, 3 * from + k) += sideways;
      matrix(3 * to + k, 3 * to + k) += sideways;
      matrix(3 * from + k, 3 * to + k) -= sideways;
      matrix(3 * to + k, 3 * from + k) -= sideways;
    }
  }
}

StrainDifferences::Ways StrainDifferences::ways(const BrickVector& x) {
  Ways d;
  for (int number = 0; number < kSprings; ++number) {
    const auto [from, to] = spring(number);
    d.col(number) = x.segment<3>(3 * to) - x.segment<3>(3 * from);
  }
  return d;
}

}  // namespace sprung
