#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "core/motion/newton_system.h"

namespace sprung {

/// Numbers the degrees of freedom that are free to move: -1 where fixed.
struct FreeDofs {
  std::vector<int> index;  // 3 m
  int count = 0;

  explicit FreeDofs(const Supports& supports);
  [[nodiscard]] Eigen::VectorXd gather(const Eigen::VectorXd& all) const;
  [[nodiscard]] Eigen::VectorXd scatter(const Eigen::VectorXd& free) const;
};

/// Lower triangle of the second derivative of the elastic energy at body.positions and of what a step adds to it, free
/// degrees of freedom only, N/m.
[[nodiscard]] Eigen::SparseMatrix<double> stiffness_matrix(const Body& body, const FreeDofs& dofs, bool definite,
                                                           const StepTerms& terms);

}  // namespace sprung
