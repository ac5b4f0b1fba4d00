#include "core/dynamics/linear/linear_solver.h"

#include <Eigen/CholmodSupport>
#include <optional>

#include "core/dynamics/linear/stiffness.h"

namespace sprung {
namespace {

/// Added to the diagonal of a matrix that may be singular, relative to its largest entry.
constexpr double kShift = 1e-9;

class DirectSolver : public LinearSolver {
 public:
  DirectSolver() { cholesky_.cholmod().print = 0; }

  bool linearize(const Body& body, const Supports& supports, bool definite, const StepTerms& terms) override {
    dofs_.emplace(supports);
    const Eigen::SparseMatrix<double> matrix = stiffness_matrix(body, *dofs_, definite, terms);
    cholesky_.setShift(definite ? kShift * matrix.diagonal().maxCoeff() : 0);
    cholesky_.compute(matrix);
    return cholesky_.info() == Eigen::Success;
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& forces, double /*tolerance*/) override {
    ++report_.solves;
    return dofs_->scatter(cholesky_.solve(dofs_->gather(forces)));
  }

  [[nodiscard]] SolveReport report() const override { return report_; }

 private:
  std::optional<FreeDofs> dofs_;
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky_;
  SolveReport report_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver() { return std::make_unique<DirectSolver>(); }

namespace {

constexpr int kFewBricks = 200;      // the direct solver is as fast up to here,
constexpr int kFewThinBricks = 600;  // in thin bodies, which take multigrid several times the iterations, up to here,
constexpr double kThinNodes = 2;     // a brick; compact bodies have 1.4
constexpr int kManyBricks = 40000;   // and it needs gigabytes from here on

bool is_small(const Body& body) {
  const int bricks = body.grid.brick_count();
  return bricks <= (body.node_count() > kThinNodes * bricks ? kFewThinBricks : kFewBricks);
}

}  // namespace

std::unique_ptr<LinearSolver> make_robust_solver(const Body& body) {
  if (body.grid.brick_count() <= kManyBricks) return make_direct_solver();
  constexpr int kPatience = 2000;
  return make_mixed_solver(kPatience);
}

namespace {

class DefaultSolver : public LinearSolver {
 public:
  bool linearize(const Body& body, const Supports& supports, bool definite, const StepTerms& terms) override {
    body_ = &body;
    supports_ = &supports;
    definite_ = definite;
    terms_ = &terms;
    is_direct_ = is_small(body);
    if (now().linearize(body, supports, definite, terms)) return true;
    if (is_direct_ || !definite || body.grid.brick_count() > kManyBricks) return false;
    is_direct_ = true;
    ++never_tried_;
    return direct_->linearize(body, supports, definite, terms);
  }

  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& forces, double tolerance) override {
    const long indefinite = multigrid_->report().indefinite;
    Eigen::VectorXd solution = now().solve(forces, tolerance);
    // A definite matrix appears indefinite only by rounding.
    const bool is_lost = solution.size() == 0 && (definite_ || multigrid_->report().indefinite == indefinite);
    if (is_direct_ || !is_lost || body_->grid.brick_count() > kManyBricks) return solution;
    if (!direct_->linearize(*body_, *supports_, definite_, *terms_)) return {};
    ++gone_direct_;
    return direct_->solve(forces, tolerance);
  }

  [[nodiscard]] Eigen::VectorXd downhill() const override { return now().downhill(); }

  [[nodiscard]] SolveReport report() const override {
    SolveReport report = multigrid_->report();
    report.solves += direct_->report().solves - gone_direct_;
    report.fallbacks = gone_direct_ + never_tried_;
    return report;
  }

 private:
  [[nodiscard]] LinearSolver& now() const { return is_direct_ ? *direct_ : *multigrid_; }

  std::unique_ptr<LinearSolver> direct_ = make_direct_solver();
  std::unique_ptr<LinearSolver> multigrid_ = make_mixed_solver();
  const Body* body_ = nullptr;
  const Supports* supports_ = nullptr;
  const StepTerms* terms_ = nullptr;
  bool definite_ = false;
  bool is_direct_ = true;
  long gone_direct_ = 0;  // solves that multigrid failed
  long never_tried_ = 0;  // matrices that it rejected
};

}  // namespace

std::unique_ptr<LinearSolver> make_default_solver() { return std::make_unique<DefaultSolver>(); }

}  // namespace sprung
