#include <Eigen/CholmodSupport>
#include <optional>

#include "core/motion/newton_system.h"
#include "core/motion/stiffness_matrix.h"

namespace sprung {
namespace {

/// Added to the diagonal of a matrix that may be singular, relative to its largest entry.
constexpr double kShift = 1e-9;

class DirectSystem : public NewtonSystem {
 public:
  DirectSystem() { cholesky_.cholmod().print = 0; }

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

std::unique_ptr<NewtonSystem> make_direct_system() { return std::make_unique<DirectSystem>(); }

}  // namespace sprung
