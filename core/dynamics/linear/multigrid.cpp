#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <optional>

#include "core/body/brick_hessian.h"
#include "core/body/brick_model.h"
#include "core/body/forces.h"
#include "core/body/solid_tiles.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/dynamics/linear/mixed_solve.h"
#include "core/dynamics/linear/multigrid_level.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/linear/volume_pressures.h"

namespace sprung {
namespace {

using multigrid::kLanes;

constexpr int kCoarsestNodes = 100;
constexpr int kCoarsestNodesAtRest = 2000;    // fewer levels, since coarse bricks are too stiff for thin parts
constexpr double kFactorFlops = 1e7;          // for the coarsest level, some 10 ms; or ...
constexpr double kFactorFlopsPerBrick = 1e4;  // ... what the smoothing of a solve costs
constexpr double kDiagonalShift = 1e-9;       // of the largest stiffness, as in linear_solver.cpp

/// Coarse bricks are too stiff in bending, the more so the closer the material is to incompressible; the smoother
/// compensates. Solid bricks, slivers next to whole ones, have eigenvalues over twice the range.
int smoothing_steps(const Body& body) {
  if (!has_springs(body.model)) return body.material.poisson > 0.47 ? 8 : 5;
  if (body.material.poisson > 0.47) return 5;
  return body.material.poisson > 0.4 ? 3 : 2;
}

/// Thin parts can be factorized fast with many nodes, and need them; neither holds for thick ones.
multigrid::LastLevel last_level(const Body& body, int max_nodes) {
  return {.max_nodes = max_nodes, .max_flops = std::max(kFactorFlops, kFactorFlopsPerBrick * body.grid.brick_count())};
}

/// Splits a whole brick matrix into its anchored part and its pull, in one lane of a block.
void put(const BrickMatrix& whole, float* matrix, float* pull) {
  for (std::size_t a = 0; a < 21; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      matrix[anchored_index(a, b) * kLanes] = float(whole(a + 3, b + 3));
    }
  }
  if (pull == nullptr) return;
  for (int row = 0; row < 24; ++row) {
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int corner = 0; corner < 8; ++corner) sum += whole(row, 3 * corner + k);
      pull[(3 * row + k) * kLanes] = float(sum);
    }
  }
}

/// Whether a symmetric matrix has an eigenvalue clearly below zero.
bool bends_downward(const BrickMatrix& matrix) {
  const double raise = 1e-7 * matrix.trace();
  return Eigen::LLT<BrickMatrix>(matrix + raise * BrickMatrix::Identity()).info() != Eigen::Success;
}

class MultigridSolver : public IterativeSolver {
 public:
  MultigridSolver(int max_iterations, bool may_be_mixed)
      : max_iterations_(max_iterations), may_be_mixed_(may_be_mixed) {}

  bool linearize(const Body& body, const Supports& supports, bool definite, const StepTerms& terms) override {
    body_ = &body;
    terms_ = &terms;
    definite_ = definite;
    // Masses stabilise every part, and then this takes longer than it saves.
    const int coarsest_nodes = terms.mass_factor > 0 ? kCoarsestNodes : kCoarsestNodesAtRest;
    if (!cycle_ || coarsest_nodes != coarsest_nodes_ || layouts_.front().bricks != body.grid.nodes) {
      coarsest_nodes_ = coarsest_nodes;
      layouts_ = multigrid::make_hierarchy(body.grid, last_level(body, coarsest_nodes));
      products_ = ProductWorkspace();
      cycle_ = std::make_unique<multigrid::Cycle>(layouts_);
    }
    fixed_ = supports.fixed;
    volumes_.reset();
    if (may_be_mixed_ && !definite && VolumePressures::help(body)) {
      volumes_.emplace(body, fixed_, 1 + terms.damping);
      if (prepare_cycle()) return true;
      volumes_.reset();  // under great pressures the rest of the stiffness may be indefinite where all of it is not
    }
    return prepare_cycle();
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& forces, double tolerance) override;

  void multiply(const Eigen::VectorXd& u, Eigen::VectorXd& forces) override;
  void precondition(const Eigen::VectorXd& forces, Eigen::VectorXd& u) override;

  [[nodiscard]] Eigen::VectorXd downhill() const override { return downhill_; }
  [[nodiscard]] SolveReport report() const override { return report_; }

 private:
  /// False if the coarsest level's matrix is not positive definite.
  [[nodiscard]] bool prepare_cycle() {
    fill_finest();
    return cycle_->prepare(smoothing_steps(*body_), fastest_of_brick());
  }
  void fill_finest();
  void fill_block(int block, const EdgeCoupling& coupling);
  void fill_solids(int first, float* matrix) const;
  void separate_volumes(int first, double* pack) const;
  [[nodiscard]] double fastest_of_brick() const;
  [[nodiscard]] bool is_peculiar(std::size_t brick) const;
  [[nodiscard]] bool needs_pull(int block) const;
  [[nodiscard]] BrickMatrix peculiar_matrix(std::size_t brick) const;
  void multiply_exactly(const Eigen::VectorXd& x, Eigen::VectorXd& product);
  void release_held(Eigen::VectorXd& vector) const;

  int max_iterations_;
  bool may_be_mixed_;
  const Body* body_ = nullptr;
  const StepTerms* terms_ = nullptr;
  bool definite_ = false;
  std::vector<bool> fixed_;
  int coarsest_nodes_ = 0;
  std::vector<multigrid::Layout> layouts_;
  std::unique_ptr<multigrid::Cycle> cycle_;
  std::vector<char> is_pinned_node_;
  std::vector<std::vector<const PointStiffness*>> points_of_brick_;  // empty if there are none at all
  ProductWorkspace products_;
  Eigen::VectorXd damping_product_;
  std::optional<VolumePressures> volumes_;  // the matrices of the cycle are without them
  multigrid::Floats single_residual_;
  multigrid::Floats single_solution_;
  Eigen::VectorXd downhill_;
  SolveReport report_;
};

void MultigridSolver::fill_finest() {
  const std::size_t nodes = body_->node_count();
  is_pinned_node_.assign(nodes, 0);
  for (std::size_t i = 0; i < fixed_.size(); ++i) {
    if (fixed_[i]) is_pinned_node_[i / 3] = 1;
  }
  points_of_brick_.clear();
  if (!terms_->points.empty() || !terms_->coupled.empty()) points_of_brick_.resize(body_->grid.nodes.size());
  for (const std::vector<PointStiffness>* points : {&terms_->points, &terms_->coupled}) {
    for (const PointStiffness& point : *points) points_of_brick_[point.brick].push_back(&point);
  }
  multigrid::Level& finest = cycle_->finest();
  finest.fixed.assign(fixed_.begin(), fixed_.end());
  finest.clear_pulls();
  for (int block = 0; block < finest.block_count(); ++block) {
    if (needs_pull(block)) finest.add_pull(block);
  }
  const EdgeCoupling coupling = edge_coupling(body_->law);
  tbb::parallel_for(0, finest.block_count(), [&](int block) { fill_block(block, coupling); });
  const double shift = definite_ ? kDiagonalShift * largest_brick_stiffness(*body_) : 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    finest.diagonal[node] = terms_->mass_factor * body_->masses[node] + shift;
  }
}

/// The largest eigenvalue of a full brick at rest relative to its nodes' own blocks; 0 if unknown.
double MultigridSolver::fastest_of_brick() const {
  if (definite_ || !points_of_brick_.empty() || !has_springs(body_->model)) return 0;
  const BrickMatrix brick = brick_model(body_->model).full_brick_hessian(*body_);
  BrickMatrix blocks = BrickMatrix::Zero();
  for (int i = 0; i < 24; i += 3) blocks.block<3, 3>(i, i) = brick.block<3, 3>(i, i);
  return Eigen::GeneralizedSelfAdjointEigenSolver<BrickMatrix>(brick, blocks, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

bool MultigridSolver::needs_pull(int block) const {
  const std::size_t first = block * kLanes;
  const std::size_t last = std::min(first + kLanes, body_->grid.nodes.size());
  for (std::size_t brick = first; brick < last; ++brick) {
    if (!points_of_brick_.empty() && !points_of_brick_[brick].empty()) return true;
    for (const int node : body_->grid.nodes[brick]) {
      if (is_pinned_node_[node] != 0) return true;
    }
  }
  return false;
}

bool MultigridSolver::is_peculiar(std::size_t brick) const {
  if (definite_ || !has_tiles(body_->model)) return true;
  if (!points_of_brick_.empty() && !points_of_brick_[brick].empty()) return true;
  return std::any_of(body_->grid.nodes[brick].begin(), body_->grid.nodes[brick].end(),
                     [&](int node) { return is_pinned_node_[node] != 0; });
}

void MultigridSolver::fill_block(int block, const EdgeCoupling& coupling) {
  multigrid::Level& finest = cycle_->finest();
  float* matrix = finest.matrix(block);
  const int first = block * kLanes;
  if (has_springs(body_->model)) {
    multigrid::kernels().stiffness_matrices(block_input(*body_), coupling, 1 + terms_->damping, first, matrix);
  } else if (has_tiles(body_->model) && !definite_) {
    fill_solids(first, matrix);
  }
  float* pull = needs_pull(block) ? finest.add_pull(block) : nullptr;
  for (int brick = first; brick < std::min(first + kLanes, body_->grid.brick_count()); ++brick) {
    const int lane = brick - first;
    const std::size_t b = brick;
    if (!is_peculiar(b)) continue;
    put(peculiar_matrix(b), matrix + lane, pull == nullptr ? nullptr : pull + lane);
  }
}

/// Matrices of solid bricks, in packs.
void MultigridSolver::fill_solids(int first, float* matrix) const {
  std::array<double, kAnchoredSize * kPackPadding> pack{};
  for (int lane = 0; lane < kLanes && first + lane < body_->grid.brick_count(); lane += kPackPadding) {
    solid_matrices(*body_, first + lane, pack.data());
    for (double& entry : pack) entry *= 1 + terms_->damping;
    if (volumes_) separate_volumes(first + lane, pack.data());
    for (std::size_t entry = 0; entry < kAnchoredSize; ++entry) {
      for (std::size_t i = 0; i < kPackPadding; ++i) {
        matrix[entry * kLanes + lane + i] = float(pack[entry * kPackPadding + i]);
      }
    }
  }
}

/// Takes the resistance of volumes out of a pack of matrices.
void MultigridSolver::separate_volumes(int first, double* pack) const {
  const int count = std::min(int(kPackPadding), body_->grid.brick_count() - first);
  for (int lane = 0; lane < count; ++lane) {
    const std::size_t brick = first + lane;
    const auto rates = volumes_->rates(brick).tail<21>();
    for (std::size_t a = 0; a < 21; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        pack[anchored_index(a, b) * kPackPadding + lane] -= volumes_->stiffness(brick) * rates[a] * rates[b];
      }
    }
  }
}

/// The matrix of a brick with more than its springs, fixed degrees of freedom removed.
BrickMatrix MultigridSolver::peculiar_matrix(std::size_t brick) const {
  BrickMatrix matrix = (1 + terms_->damping) * body_brick_hessian(*body_, brick, definite_);
  if (volumes_) matrix -= volumes_->stiffness(brick) * volumes_->rates(brick) * volumes_->rates(brick).transpose();
  if (definite_ && bends_downward(matrix)) matrix = without_negative_curvature(matrix);
  if (!points_of_brick_.empty()) {
    for (const PointStiffness* point : points_of_brick_[brick]) add_point_stiffness(*point, matrix);
  }
  for (int i = 0; i < 24; ++i) {
    const int node = body_->grid.nodes[brick][i / 3];
    if (!fixed_[3 * node + i % 3]) continue;
    matrix.row(i).setZero();
    matrix.col(i).setZero();
  }
  return matrix;
}

void MultigridSolver::release_held(Eigen::VectorXd& vector) const {
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    if (fixed_[i]) vector[i] = 0;
  }
}

void MultigridSolver::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& product) {
  if (definite_) {
    cycle_->finest().multiply(x, product);
    for (PointStiffness point : terms_->coupled) {
      point.stiffness = -point.stiffness;
      add_point_product(*body_, point, x, product);
    }
  } else {
    multiply_exactly(x, product);
  }
  release_held(product);
}

void MultigridSolver::multiply_exactly(const Eigen::VectorXd& x, Eigen::VectorXd& product) {
  multiply_stiffness(*body_, x, products_, product);
  if (terms_->damping != 0) {
    multiply_damping(*body_, terms_->damping_positions, terms_->damping, x, products_, damping_product_);
    product += damping_product_;
  }
  if (terms_->mass_factor != 0) {
    for (Eigen::Index i = 0; i < x.size(); ++i) product[i] += terms_->mass_factor * body_->masses[i / 3] * x[i];
  }
  for (const PointStiffness& point : terms_->points) add_point_product(*body_, point, x, product);
}

void MultigridSolver::precondition(const Eigen::VectorXd& residual, Eigen::VectorXd& correction) {
  const double largest = residual.lpNorm<Eigen::Infinity>();  // scales it into the range of single precision
  if (largest == 0) {
    correction.setZero(residual.size());
    return;
  }
  single_residual_ = (residual / largest).cast<float>();
  cycle_->apply(single_residual_, single_solution_);
  correction = largest * single_solution_.cast<double>();
}

Eigen::VectorXd MultigridSolver::solve(const Eigen::VectorXd& forces, double tolerance) {
  Eigen::VectorXd free = forces;
  release_held(free);
  downhill_.resize(0);
  const StoppingCriterion end{.tolerance = tolerance, .max_iterations = max_iterations_};
  const auto product_of = [&](const Eigen::VectorXd& x, Eigen::VectorXd& product) { multiply(x, product); };
  const auto correct = [&](const Eigen::VectorXd& residual, Eigen::VectorXd& correction) {
    precondition(residual, correction);
  };
  if (volumes_) return solve_mixed({*volumes_, product_of, correct}, free, end, report_, &downhill_);
  return conjugate_gradients(free, end, product_of, correct, report_, &downhill_);
}

}  // namespace

std::unique_ptr<IterativeSolver> make_multigrid_solver(int max_iterations) {
  return std::make_unique<MultigridSolver>(max_iterations, false);
}

std::unique_ptr<LinearSolver> make_mixed_solver(int max_iterations) {
  return std::make_unique<MultigridSolver>(max_iterations, true);
}

}  // namespace sprung
