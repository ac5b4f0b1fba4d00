#pragma once
#include <Eigen/Core>

#include "core/law/brick_vector.h"
#include "core/types.h"

namespace sprung {

/// Differences of the squared lengths |d|^2 of a brick's twelve edges and twelve face diagonals, which vanish in every
/// uniform strain: how the strain of its trilinear map changes through the brick, at the centroid c of its solid. With
/// s = -1, +1 the low and the high side and c in brick lengths:
///   b_ij = sum of |d|^2 / (2 h^3) of the edges along i, each times s_j (1/2 + s_k c_k):         strain ii along j, 1/m
///   q_i  = the same, each times s_j s_k, over h:                                   u_i = x y z, 1/m^2
///   t_k  = (g of the high face - g of the low face) / h + h (c_i q_i + c_j q_j):   shear ij along k, 1/m
///     with g = (|one diagonal|^2 - |the other|^2) / (4 h^2)
/// A force on them is a tension along edges and diagonals, which conserves momentum and angular momentum.
class StrainDifferences {
 public:
  static constexpr int kGradients = 9;  // b_01, b_02, b_12, b_10, b_20, b_21, t_0, t_1, t_2
  static constexpr int kAll = 12;       // and q_0, q_1, q_2
  using Values = Eigen::Matrix<double, kAll, 1>;
  using Rates = Eigen::Matrix<double, kAll, 24>;

  /// The row of b_ij, i != j; that of t_k is 6 + k.
  [[nodiscard]] static constexpr int row_of(int i, int j) { return 2 * i + (j == (i + 1) % 3 ? 0 : 1); }

  /// `h`: m.
  StrainDifferences(double h, const Vec3& centroid);

  [[nodiscard]] Values values(const BrickVector& x) const;
  /// Derivatives with respect to the corners.
  [[nodiscard]] Rates rates(const BrickVector& x) const;
  /// How values() change with v.
  [[nodiscard]] Values change(const BrickVector& x, const BrickVector& v) const;
  /// Forces on the corners, rates()^T times `force`.
  [[nodiscard]] BrickVector pull(const BrickVector& x, const Values& force) const;
  /// The second derivatives of the values, each times its `force`; `definite`: of springs in tension only.
  void add_curvature(const Values& force, bool definite, BrickMatrix& matrix) const;

 private:
  static constexpr int kSprings = 24;
  using Springs = Eigen::Matrix<double, kSprings, 1>;
  using Ways = Eigen::Matrix<double, 3, kSprings>;

  [[nodiscard]] static Ways ways(const BrickVector& x);

  Eigen::Matrix<double, kAll, kSprings> modes_;
};

}  // namespace sprung
