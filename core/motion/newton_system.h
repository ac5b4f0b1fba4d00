#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/body/body.h"

namespace sprung {

/// Which of a body's 3 m degrees of freedom (3 node + axis) keep the value that its positions have.
struct Supports {
  std::vector<bool> fixed;  // 3 m

  explicit Supports(int node_count) : fixed(3 * static_cast<std::size_t>(node_count), false) {}
  void fix(int node, int axis) { fixed[static_cast<std::size_t>(3 * node + axis)] = true; }
  void fix(int node) {
    for (int axis = 0; axis < 3; ++axis) fix(node, axis);
  }
};

/// The linear systems that Newton's method and linear statics meet: K u = f, with K the second derivative of the
/// elastic energy at a body's positions and u zero where it is supported. The seam between the equations and the ways
/// to solve them.
class NewtonSystem {
 public:
  virtual ~NewtonSystem() = default;

  /// Takes K at body.positions; with `definite`, each brick's K without its negative curvature, and
  /// motions that meet no resistance held by a stiffness below rounding.
  /// False where K is not positive definite, and then solve() must not be called.
  virtual bool linearize(const Body& body, const Supports& supports, bool definite) = 0;

  /// u (3 m, m) for the forces f (3 m, N); entries of f at supports are ignored.
  [[nodiscard]] virtual Eigen::VectorXd solve(const Eigen::VectorXd& forces) const = 0;
};

/// Sparse Cholesky (CHOLMOD, supernodal): exact, for small bodies and as the oracle of others. Memory and time grow
/// faster than the body: some 250 MB and 2 s at 16 000 bricks.
[[nodiscard]] std::unique_ptr<NewtonSystem> make_direct_system();

}  // namespace sprung
