#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "core/body/body.h"
#include "core/body/brick_hessian.h"
#include "core/body/forces.h"
#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// Adds a point stiffness to the matrix of its brick.
void add_point_stiffness(const PointStiffness& point, BrickMatrix& matrix);

/// Adds the forces (3 m, N) of a point stiffness for displacements x of the nodes (3 m, m).
void add_point_product(const Body& body, const PointStiffness& point, const Eigen::VectorXd& x,
                       Eigen::VectorXd& product);

/// Numbers the degrees of freedom that are free to move: -1 if fixed.
struct FreeDofs {
  std::vector<int> index;  // 3 m
  int count = 0;

  explicit FreeDofs(const Supports& supports);
  [[nodiscard]] Eigen::VectorXd gather(const Eigen::VectorXd& all) const;
  [[nodiscard]] Eigen::VectorXd scatter(const Eigen::VectorXd& free) const;
};

/// Lower triangle of the second derivative of the elastic energy at body.positions and of the terms of a step, free
/// degrees of freedom only, N/m.
[[nodiscard]] Eigen::SparseMatrix<double> stiffness_matrix(const Body& body, const FreeDofs& dofs, bool definite,
                                                           const StepTerms& terms);

/// Workspace for the products of one body, kept between calls.
struct ProductWorkspace {
  CornerSums sums;
  SpringSystem springs;
};

/// K u, 3 m, N: K the second derivative of a body's elastic energy at its current positions. Exact, matrix-free; the
/// same bits for any number of threads.
void multiply_stiffness(const Body& body, const Eigen::VectorXd& u, ProductWorkspace& workspace,
                        Eigen::VectorXd& product);

/// factor K_along u, likewise: K_along the stiffness used by damping, the axial one of the springs, with
/// nodes at `positions` (m x 3, m).
void multiply_damping(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                      ProductWorkspace& workspace, Eigen::VectorXd& product);

}  // namespace sprung
