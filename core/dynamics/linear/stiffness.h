#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "core/body/body.h"
#include "core/body/brick_hessian.h"
#include "core/body/forces.h"
#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// Adds what holds a point to the matrix of its brick.
void add_point_stiffness(const PointStiffness& point, BrickMatrix& matrix);

/// Adds the forces (3 m, N) that hold the point while the nodes move by x (3 m, m).
void add_point_product(const Body& body, const PointStiffness& point, const Eigen::VectorXd& x,
                       Eigen::VectorXd& product);

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

/// Room for the products of one body, kept from one to the next.
struct ProductWorkspace {
  CornerSums sums;
  SpringSystem springs;
};

/// K u, 3 m, N: K the second derivative of a body's elastic energy where it stands. Exact, without any matrix; the same
/// bits for any number of threads.
void multiply_stiffness(const Body& body, const Eigen::VectorXd& u, ProductWorkspace& workspace,
                        Eigen::VectorXd& product);

/// factor K_along u, likewise: K_along the stiffness that damping sees, that of the springs along themselves, without
/// the guard, with nodes at `positions` (m x 3, m).
void multiply_damping(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                      ProductWorkspace& workspace, Eigen::VectorXd& product);

}  // namespace sprung
