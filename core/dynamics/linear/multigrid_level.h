#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "core/dynamics/linear/multigrid_hierarchy.h"

namespace sprung::multigrid {

using Floats = Eigen::VectorXf;  // 3 per node

/// The matrix of one level, brick by brick, and the products with it: the same bits for any number of threads.
/// A = sum of the bricks' matrices + diagonal. The layout must outlive it.
class Level {
 public:
  explicit Level(const Layout& layout);

  [[nodiscard]] const Layout& layout() const { return *layout_; }
  [[nodiscard]] int block_count() const { return isize(pull_of_block_); }
  [[nodiscard]] float* matrix(int block) { return &matrices_[kAnchoredSize * kLanes * std::size_t(block)]; }
  [[nodiscard]] FineMatrices matrices() const;

  /// Gives a block room for pulls (zero), if it has none yet.
  float* add_pull(int block);
  void clear_pulls();

  /// Sets Galerkin's matrices from the finer level, its diagonal lumped, and the degrees of freedom that are entirely
  /// fixed.
  void coarsen(const Level& fine);

  /// Per node, N/m: added to the matrix. Masses over the step squared, and a term that keeps a free body from drifting.
  std::vector<double> diagonal;

  /// 3 m, degrees of freedom that do not move. (Rounding leaves them traces of stiffness.)
  std::vector<char> fixed;
  void release_held(Floats& x) const;

  /// Call when matrices and diagonal are set: computes the inverse of the nodes' own 3 x 3 blocks and the largest
  /// eigenvalue of the matrix scaled by them. `fastest_of_brick` is that of a single brick, which bounds it; 0: found
  /// by Lanczos' method.
  void prepare_smoother(double fastest_of_brick);

  void multiply(const Floats& x, Floats& product) const;
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) const;

  /// `steps` of Chebyshev's polynomial of the fourth kind (Lottes, "Optimal polynomial smoothers for multigrid
  /// V-cycles", 2023) in block-Jacobi's matrix. `residual` is that of x, before and after.
  void smooth(int steps, Floats& x, Floats& residual) const;

  /// The same for a residual that is not needed afterwards: one product less.
  void smooth_last(int steps, Floats& x, Floats& residual) const { smooth(steps, x, residual, false); }

  /// The lower triangle of the matrix, 3 m x 3 m.
  [[nodiscard]] Eigen::SparseMatrix<double> sparse() const;

 private:
  void smooth(int steps, Floats& x, Floats& residual, bool with_residual) const;
  template <class Vector, class Apply>
  void multiply_bricks(const Vector& x, Vector& product, Apply apply) const;
  void find_fastest();
  [[nodiscard]] LevelBlock input(int block) const;
  [[nodiscard]] double entry(std::size_t brick, std::size_t row, std::size_t column) const;

  const Layout* layout_;
  std::vector<float> matrices_;
  std::vector<float> pulls_;
  std::vector<int> pull_of_block_;
  std::vector<Eigen::Matrix3f> inverse_blocks_;  // per node; zero for nodes without stiffness
  float fastest_ = 1;
  std::vector<std::size_t> corner_places_;  // of the x component, in corner forces, as layout.corners.corners
  mutable Eigen::VectorXf corner_forces_;
  mutable Eigen::VectorXd corner_forces_double_;
  mutable Floats direction_;
  mutable Floats product_;
};

/// Fine to coarse: the transpose of the interpolation.
void restrict_to_coarse(const Interpolation& hang, const Floats& fine, Floats& coarse);
/// Coarse to fine: adds.
void add_from_coarse(const Interpolation& hang, const Floats& coarse, Floats& fine);

/// Multigrid's cycle as a preconditioner: a symmetric, positive definite approximation of the inverse, in single
/// precision. The layouts must outlive it.
class Cycle {
 public:
  explicit Cycle(const std::vector<Layout>& layouts);
  ~Cycle();

  /// The finest level, to be filled in before prepare().
  [[nodiscard]] Level& finest() { return levels_.front(); }
  [[nodiscard]] const Level& finest() const { return levels_.front(); }

  /// Builds all coarser levels. `steps` of the smoother before and after. `fastest_of_brick`: see
  /// Level::prepare_smoother(). False if the coarsest level's matrix is not positive definite.
  bool prepare(int steps, double fastest_of_brick);

  /// x for the right side b (both 3 m).
  void apply(const Floats& b, Floats& x) const;

 private:
  struct Room {  // of a level
    Floats right, residual, answer, correction, product, first_product, left, second;
  };

  void descend(std::size_t level, Floats& residual, Floats& x) const;
  /// At most two steps of conjugate gradients around descend(): if coarse bricks are too stiff, as for the bending of
  /// thin parts, errors do not accumulate over the levels (Notay and Vassilevski, "Recursive Krylov-based multigrid
  /// cycles", 2008).
  void solve_coarse(std::size_t level, const Floats& b, Floats& x) const;
  void solve_coarsest(const Floats& residual, Floats& x) const;

  std::vector<Level> levels_;
  int steps_ = 2;
  struct Coarsest;
  std::unique_ptr<Coarsest> coarsest_;  // its factorization
  mutable std::vector<Room> rooms_;
};

}  // namespace sprung::multigrid
