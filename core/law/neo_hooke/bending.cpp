#include "core/law/neo_hooke/bending.h"

#include <Eigen/Eigenvalues>

namespace sprung {
namespace {

using BendingStiffness = Eigen::Matrix<double, 6, 6>;

/// The row of b_ij.
int row_of(int i, int j) { return 2 * i + (j == (i + 1) % 3 ? 0 : 1); }

BendingStiffness bending_stiffness(const Material& material, const Mat3& m) {
  const double plate = material.young / (1 - material.poisson * material.poisson);
  BendingStiffness stiffness = BendingStiffness::Zero();
  for (int g = 0; g < 3; ++g) {
    const int i = (g + 1) % 3;
    const int k = (g + 2) % 3;
    const int one = row_of(i, g);
    const int other = row_of(k, g);
    stiffness(one, one) = plate * m(g, g);
    stiffness(other, other) = plate * m(g, g);
    stiffness(one, other) = stiffness(other, one) = plate * material.poisson * m(g, g);
    stiffness(row_of(g, i), row_of(g, k)) = stiffness(row_of(g, k), row_of(g, i)) = material.young * m(i, k);
  }
  return stiffness;
}

bool is_definite(const BendingStiffness& stiffness) {
  return Eigen::SelfAdjointEigenSolver<BendingStiffness>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()[0] >=
         -1e-12 * stiffness.trace();
}

}  // namespace

SquareTerm<6> bending_term(const Material& material, double h, const Vec3& centroid, const Mat3& second) {
  SquareTerm<6> term{.pairs = &kEdges, .modes = {}, .stiffness = bending_stiffness(material, second)};
  term.modes.setZero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    for (int side = 0; side < 4; ++side) {
      const double in_j = edge_sign(side, 0);
      const double in_k = edge_sign(side, 1);
      term.modes(row_of(i, j), 4 * i + side) = in_j * (0.5 + in_k * centroid[k]) / (2 * h * h * h);
      term.modes(row_of(i, k), 4 * i + side) = in_k * (0.5 + in_j * centroid[j]) / (2 * h * h * h);
    }
  }
  return term;
}

Mat3 stable_moments(const Material& material, const Mat3& second) {
  const Mat3 diagonal = second.diagonal().asDiagonal();
  const auto kept = [&](double share) -> Mat3 { return diagonal + share * (second - diagonal); };
  if (is_definite(bending_stiffness(material, second))) return second;
  double low = 0;
  double high = 1;
  for (int halving = 0; halving < 20; ++halving) {
    const double middle = (low + high) / 2;
    (is_definite(bending_stiffness(material, kept(middle))) ? low : high) = middle;
  }
  return kept(low);
}

}  // namespace sprung
