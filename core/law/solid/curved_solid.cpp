#include "core/law/solid/curved_solid.h"

#include <Eigen/Cholesky>
#include <array>

#include "core/law/hexahedron.h"
#include "core/law/solid/strain_differences.h"

namespace sprung {
namespace {

/// The component of engineering strain: of ii it is i, of ij it is 3 + k, k the third axis.
int component_of(int i, int j) { return i == j ? i : 6 - i - j; }

/// The component `strain` along an axis.
int number_of(int strain, int axis) { return 3 * strain + axis; }

struct Ways {
  std::array<int, 9> corners{};  // by the row of StrainDifferences
  std::array<int, 9> free{};     // ii along i; ij along i, for each i and j
};

Ways list_ways() {
  Ways ways;
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    ways.free[count++] = number_of(i, i);
    ways.corners[6 + i] = number_of(3 + i, i);
    for (int j = 0; j < 3; ++j) {
      if (j == i) continue;
      ways.corners[StrainDifferences::row_of(i, j)] = number_of(i, j);
      ways.free[count++] = number_of(component_of(i, j), i);
    }
  }
  return ways;
}

}  // namespace

Mat3 shear_matrix(const Vec3& rows) {
  Mat3 matrix;
  matrix << 0, rows[2], rows[1], rows[2], 0, rows[0], rows[1], rows[0], 0;
  return matrix;
}

CurvedSolid curved_solid(double poisson, const SolidMoments& moments) {
  static const Ways kWays = list_ways();
  Material unit;
  unit.young = 1;
  unit.poisson = poisson;
  const Eigen::Matrix<double, 6, 6> law = elasticity(unit);
  Eigen::Matrix<double, 18, 18> energy;
  for (int one = 0; one < 6; ++one) {
    for (int other = 0; other < 6; ++other) {
      energy.block<3, 3>(3 * one, 3 * other) = law(one, other) * moments.covariance;
    }
  }
  using Square = Eigen::Matrix<double, 9, 9>;
  const Square of_free = energy(kWays.free, kWays.free);
  const Square between = energy(kWays.free, kWays.corners);
  const Square free = -of_free.llt().solve(between);
  CurvedSolid solid;
  solid.stiffness = energy(kWays.corners, kWays.corners) + between.transpose() * free;
  solid.stiffness = (0.5 * (solid.stiffness + solid.stiffness.transpose())).eval();
  Eigen::Matrix<double, 18, 9> all = Eigen::Matrix<double, 18, 9>::Zero();
  for (int row = 0; row < 9; ++row) {
    all(kWays.corners[row], row) = 1;
    all.row(kWays.free[row]) = free.row(row);
  }
  solid.tangent.setZero();
  for (int i = 0; i < 3; ++i) {
    const double off = moments.centroid[i];
    for (int j = 0; j < 3; ++j) {
      if (j == i) continue;
      // u_j by i twice: the shear ij along i less the strain ii along j.
      const int shear = component_of(i, j);
      solid.tangent.row(shear - 3) += 0.5 * off * (all.row(number_of(shear, i)) - all.row(number_of(i, j)));
    }
  }
  return solid;
}

}  // namespace sprung
