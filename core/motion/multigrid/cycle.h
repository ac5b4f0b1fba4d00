#pragma once
#include <Eigen/Cholesky>

#include "core/motion/multigrid/level.h"

namespace sprung::multigrid {

/// Multigrid's cycle as a preconditioner: a symmetric, positive definite approximation of the inverse, in single
/// precision. The layouts must outlive it.
class Cycle {
 public:
  explicit Cycle(const std::vector<Layout>& layouts);

  /// The finest level, to be filled in before prepare().
  [[nodiscard]] Level& finest() { return levels_.front(); }
  [[nodiscard]] const Level& finest() const { return levels_.front(); }

  /// Makes all coarser levels. `steps` of the smoother before and after. `fastest_of_brick`:
  /// see Level::prepare_smoother(). False where the coarsest level's matrix is not
  /// positive definite.
  bool prepare(int steps, double fastest_of_brick);

  /// x for the right side b (both 3 m).
  void apply(const Floats& b, Floats& x) const;

 private:
  struct Room {  // of a level
    Floats right, residual, answer, correction, product, first_product, left, second;
  };

  void descend(std::size_t level, Floats& residual, Floats& x) const;
  /// Two steps at most of conjugate gradients around descend(): where coarse bricks are too stiff, as they are for the
  /// bending of thin parts, their levels do not make each other worse (Notay and Vassilevski, "Recursive Krylov-based
  /// multigrid cycles", 2008).
  void solve_coarse(std::size_t level, const Floats& b, Floats& x) const;
  void solve_coarsest(const Floats& residual, Floats& x) const;

  std::vector<Level> levels_;
  int steps_ = 2;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  mutable std::vector<Room> rooms_;
};

}  // namespace sprung::multigrid
