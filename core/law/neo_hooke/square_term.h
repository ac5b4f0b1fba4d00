#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "core/bricks/brick_topology.h"
#include "core/law/brick_vector.h"
#include "core/types.h"

namespace sprung {

/// A part of a brick's energy that is quadratic in N differences of the squared lengths of twelve springs:
///   W = 1/2 z^T K z,   z = M (|d_1|^2, ..., |d_12|^2),   d_p the way between the corners of pair p.
/// Its gradient is a tension along each pair, which conserves momentum and angular momentum whatever M and K.
template <int N>
struct SquareTerm {
  const std::array<CornerPair, 12>* pairs;
  Eigen::Matrix<double, N, 12> modes;     // M
  Eigen::Matrix<double, N, N> stiffness;  // K, positive semidefinite

  [[nodiscard]] double energy(const BrickVector& x) const {
    const Eigen::Matrix<double, N, 1> z = modes * ways(x).colwise().squaredNorm().transpose();
    return 0.5 * z.dot(stiffness * z);
  }

  void add_forces(const BrickVector& x, BrickVector& forces) const {
    const Ways d = ways(x);
    const Tensions tension = tensions(d);
    for (int p = 0; p < 12; ++p) {
      const auto [from, to] = (*pairs)[p];
      const Vec3 pull = tension[p] * d.col(p);
      forces.segment<3>(3 * from) += pull;
      forces.segment<3>(3 * to) -= pull;
    }
  }

  /// `definite`: without the springs that push, which would turn over.
  void add_hessian(const BrickVector& x, bool definite, BrickMatrix& matrix) const {
    const Ways d = ways(x);
    add_along(d, matrix);
    const Tensions tension = tensions(d);
    for (int p = 0; p < 12; ++p) {
      const double sideways = definite ? std::max(tension[p], 0.0) : tension[p];
      const auto [from, to] = (*pairs)[p];
      for (int k = 0; k < 3; ++k) {
        matrix(3 * from + k, 3 * from + k) += sideways;
        matrix(3 * to + k, 3 * to + k) += sideways;
        matrix(3 * from + k, 3 * to + k) -= sideways;
        matrix(3 * to + k, 3 * from + k) -= sideways;
      }
    }
  }

  /// What resists the rates of z.
  void add_damping(const BrickVector& x, BrickMatrix& matrix) const { add_along(ways(x), matrix); }

  void add_damping_product(const BrickVector& x, const BrickVector& v, BrickVector& product) const {
    const Ways d = ways(x);
    const Tensions along = 2 * d.cwiseProduct(ways(v)).colwise().sum().transpose();
    const Tensions tension = 2 * (modes.transpose() * (stiffness * (modes * along)));
    for (int p = 0; p < 12; ++p) {
      const auto [from, to] = (*pairs)[p];
      const Vec3 pull = tension[p] * d.col(p);
      product.segment<3>(3 * from) -= pull;
      product.segment<3>(3 * to) += pull;
    }
  }

 private:
  using Ways = Eigen::Matrix<double, 3, 12>;
  using Tensions = Eigen::Matrix<double, 12, 1>;  // force over length, N/m

  [[nodiscard]] Ways ways(const BrickVector& x) const {
    Ways d;
    for (int p = 0; p < 12; ++p) {
      const auto [from, to] = (*pairs)[p];
      d.col(p) = x.segment<3>(3 * to) - x.segment<3>(3 * from);
    }
    return d;
  }

  [[nodiscard]] Tensions tensions(const Ways& d) const {
    return 2 * (modes.transpose() * (stiffness * (modes * d.colwise().squaredNorm().transpose())));
  }

  void add_along(const Ways& d, BrickMatrix& matrix) const {
    Eigen::Matrix<double, N, 24> rates = Eigen::Matrix<double, N, 24>::Zero();  // of z by the corners
    for (int p = 0; p < 12; ++p) {
      const auto [from, to] = (*pairs)[p];
      const Eigen::Matrix<double, N, 3> rate = 2 * modes.col(p) * d.col(p).transpose();
      rates.template middleCols<3>(3 * from) -= rate;
      rates.template middleCols<3>(3 * to) += rate;
    }
    matrix += rates.transpose() * stiffness * rates;
  }
};

}  // namespace sprung
