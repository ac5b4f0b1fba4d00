#include "core/dynamics/statics/buckling.h"

#include <Spectra/SymGEigsSolver.h>

#include <algorithm>

#include "core/bricks/embedding.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/statics/free_motion.h"
#include "core/error.h"

namespace sprung {
namespace {

using Vector = Eigen::VectorXd;

constexpr double kSolved = 1e-10;    // of a linear system
constexpr double kConverged = 1e-6;  // of a factor
constexpr int kMoreVectors = 12;     // of the search than factors
constexpr int kMaxRestarts = 60;

using CornerMatrix = Eigen::Matrix<double, 8, 8>;

Mat3 tensor_of(const Eigen::Matrix<double, 6, 1>& s) {
  Mat3 tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return tensor;
}

/// Of one brick, N/m, the same for the three directions: by two Gauss points along each axis.
CornerMatrix geometric_stiffness(const Body& body, std::size_t brick, const StressTensors& stresses) {
  constexpr double kGauss = 0.21132486540518713;  // (1 - 1 / sqrt(3)) / 2
  Eigen::Matrix<double, 8, 6> at_corners;
  for (int corner = 0; corner < 8; ++corner) at_corners.row(corner) = stresses.row(body.grid.nodes[brick][corner]);
  // Columns: the axes of the grid in the world, in which the body may be turned.
  const Points& rest = body.rest_positions;
  const auto& nodes = body.grid.nodes[brick];
  Mat3 turned;
  for (int axis = 0; axis < 3; ++axis) {
    turned.col(axis) = (rest.row(nodes[std::size_t(1) << axis]) - rest.row(nodes[0])).transpose().normalized();
  }
  CornerMatrix sum = CornerMatrix::Zero();
  for (int point = 0; point < 8; ++point) {
    const auto along = [&](int axis) { return (point >> axis & 1) != 0 ? 1 - kGauss : kGauss; };
    const Vec3 local(along(0), along(1), along(2));
    const Mat3 stress = turned.transpose() * tensor_of(at_corners.transpose() * trilinear_weights(local)) * turned;
    const Eigen::Matrix<double, 8, 3> gradients = trilinear_gradients(local);
    sum += gradients * stress * gradients.transpose() / 8;
  }
  return body.grid.fill[brick] * body.grid.brick_size * sum;
}

/// K and K_g over the free degrees of freedom.
class BucklingProblem {
 public:
  BucklingProblem(const Body& body, const Supports& supports, const StressTensors& stresses,
                  const std::function<void()>& between)
      : body_(body), supports_(supports), dofs_(supports), terms_(support_terms(supports)), between_(between) {
    body_.positions = body.rest_positions;
    for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
      geometric_.push_back(geometric_stiffness(body, brick, stresses));
    }
    if (!solver_->linearize(body_, supports_, false, terms_)) {
      throw_if_free(body_, supports_, "no buckling load");
      throw Error(ErrorKind::kFailed, "the stiffness of the body at rest is not positive definite");
    }
  }

  [[nodiscard]] Eigen::Index size() const { return dofs_.count; }
  [[nodiscard]] Vector scatter(const Vector& free) const { return dofs_.scatter(free); }

  /// -K_g x.
  [[nodiscard]] Vector geometric(const Vector& x) const {
    const Vector all = dofs_.scatter(x);
    Vector product = Vector::Zero(all.size());
    for (std::size_t brick = 0; brick < geometric_.size(); ++brick) {
      const auto& nodes = body_.grid.nodes[brick];
      Eigen::Matrix<double, 8, 3> moved;
      for (int c = 0; c < 8; ++c) moved.row(c) = all.segment<3>(Eigen::Index{3} * nodes[c]).transpose();
      const Eigen::Matrix<double, 8, 3> forces = geometric_[brick] * moved;
      for (int c = 0; c < 8; ++c) product.segment<3>(Eigen::Index{3} * nodes[c]) -= forces.row(c).transpose();
    }
    return dofs_.gather(product);
  }

  [[nodiscard]] Vector stiffness(const Vector& x) const {
    const Vector all = dofs_.scatter(x);
    Vector product;
    multiply_stiffness(body_, all, workspace_, product);
    for (const SpringSupport& support : supports_.springs) add_point_product(body_, support.spring, all, product);
    return dofs_.gather(product);
  }

  [[nodiscard]] Vector compliance(const Vector& forces) const {
    if (between_) between_();
    const Vector solution = solver_->solve(dofs_.scatter(forces), kSolved);
    if (solution.size() == 0)
      throw Error(ErrorKind::kFailed, "a linear system of the search for buckling was not solved");
    return dofs_.gather(solution);
  }

 private:
  Body body_;
  const Supports& supports_;
  FreeDofs dofs_;
  StepTerms terms_;
  std::function<void()> between_;
  std::vector<CornerMatrix> geometric_;  // by brick
  std::unique_ptr<LinearSolver> solver_ = make_default_solver();
  mutable ProductWorkspace workspace_;
};

/// As Spectra takes its matrices.
class GeometricStiffness {
 public:
  using Scalar = double;
  explicit GeometricStiffness(const BucklingProblem& problem) : problem_(problem) {}
  [[nodiscard]] Eigen::Index rows() const { return problem_.size(); }
  [[nodiscard]] Eigen::Index cols() const { return problem_.size(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()) = problem_.geometric(Eigen::Map<const Vector>(x, rows()));
  }

 private:
  const BucklingProblem& problem_;
};

class Stiffness {
 public:
  using Scalar = double;
  explicit Stiffness(const BucklingProblem& problem) : problem_(problem) {}
  [[nodiscard]] Eigen::Index rows() const { return problem_.size(); }
  [[nodiscard]] Eigen::Index cols() const { return problem_.size(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()) = problem_.stiffness(Eigen::Map<const Vector>(x, rows()));
  }
  void solve(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()) = problem_.compliance(Eigen::Map<const Vector>(x, rows()));
  }

 private:
  const BucklingProblem& problem_;
};

using Search = Spectra::SymGEigsSolver<GeometricStiffness, Stiffness, Spectra::GEigsMode::RegularInverse>;

/// Whether the loads stiffen the body far more than they weaken it: there is then no factor worth looking for.
bool is_pulled(GeometricStiffness& geometric, Stiffness& stiffness, int vectors) {
  Search search(geometric, stiffness, 1, vectors);
  search.init();
  search.compute(Spectra::SortRule::LargestMagn, kMaxRestarts, kConverged);
  return search.info() == Spectra::CompInfo::Successful && search.eigenvalues()[0] < 0;
}

}  // namespace

BucklingModes find_buckling(const Body& body, const Supports& supports, const StressTensors& stresses, int count,
                            const std::function<void()>& between) {
  const BucklingProblem problem(body, supports, stresses, between);
  GeometricStiffness geometric(problem);
  Stiffness stiffness(problem);
  const int vectors = int(std::min<Eigen::Index>(2 * count + kMoreVectors, problem.size()));
  if (count < 1 || count >= vectors) throw Error(ErrorKind::kBadInput, "the body is too small for so many factors");
  Search search(geometric, stiffness, count, vectors);
  search.init();
  search.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, kConverged);
  if (search.info() != Spectra::CompInfo::Successful) {
    if (is_pulled(geometric, stiffness, vectors)) return {};
    throw Error(ErrorKind::kFailed, "the search for the buckling load did not converge; use fewer bricks");
  }
  const Vector inverse = search.eigenvalues();  // largest first
  const auto positive = std::count_if(inverse.begin(), inverse.end(), [](double value) { return value > 0; });
  BucklingModes modes;
  modes.factors = inverse.head(positive).cwiseInverse();
  modes.shapes.resize(3 * body.node_count(), positive);
  for (Eigen::Index mode = 0; mode < positive; ++mode) {
    const Vector shape = problem.scatter(search.eigenvectors().col(mode));
    modes.shapes.col(mode) = shape / shape.cwiseAbs().maxCoeff();
  }
  return modes;
}

}  // namespace sprung
