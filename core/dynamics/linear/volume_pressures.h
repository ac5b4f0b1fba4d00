#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/body/body.h"
#include "core/law/brick_vector.h"

namespace sprung {

/// Most of the resistance of nearly incompressible bricks to changes of their volume, separated from the rest of their
/// stiffness K at a body's current positions:
///   K = A + G S G^T
/// G (3 m x bricks) are the derivatives of the bricks' volume ratios, S is diagonal, and A the stiffness of a material
/// that multigrid handles well. With the pressures p = S G^T u as unknowns of their own, the convergence of a solver
/// hardly depends on S. Source: Benzi, Golub, Liesen, "Numerical solution of saddle point problems", Acta Numerica 14,
/// 2005.
class VolumePressures {
 public:
  /// Whether a body's material is so close to incompressible that this saves time.
  [[nodiscard]] static bool help(const Body& body);

  /// Of `factor` times the stiffness of a body of model kCalibrated; `fixed`: degrees of freedom (3 m) that do not
  /// move. The body must outlive it.
  VolumePressures(const Body& body, const std::vector<bool>& fixed, double factor);

  /// Derivatives of a brick's volume ratio by its corners, 1/m, zero where these are fixed: its column of G.
  [[nodiscard]] const BrickVector& rates(std::size_t brick) const { return rates_[brick]; }
  /// Its entry of S, N m.
  [[nodiscard]] double stiffness(std::size_t brick) const { return stiffness_[Eigen::Index(brick)]; }
  /// All of them.
  [[nodiscard]] const Eigen::VectorXd& stiffness() const { return stiffness_; }
  /// The norms of their columns of G S, N; some positive number where a column is zero.
  [[nodiscard]] const Eigen::VectorXd& largest_forces() const { return largest_forces_; }

  /// G^T u, of displacements (3 m, m).
  [[nodiscard]] Eigen::VectorXd ratios(const Eigen::VectorXd& u) const;
  /// G p (3 m, N), of pressures times volumes (N m). The same bits for any number of threads.
  [[nodiscard]] Eigen::VectorXd forces(const Eigen::VectorXd& pressures);
  /// Approximately (S^-1 + G^T A^-1 G)^-1 times ratios, N m.
  [[nodiscard]] Eigen::VectorXd pressures(const Eigen::VectorXd& ratios) const {
    return response_.cwiseProduct(ratios);
  }

 private:
  const Body& body_;
  std::vector<BrickVector> rates_;
  Eigen::VectorXd stiffness_;
  Eigen::VectorXd largest_forces_;
  Eigen::VectorXd response_;  // N m
  CornerSums sums_;
};

}  // namespace sprung
