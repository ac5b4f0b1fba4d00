#include "core/dynamics/linear/mixed_solve.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace sprung {
namespace {

constexpr int kMaxBasis = 60;         // iterations until a restart, some 60 bytes a node each
constexpr double kMargin = 0.5;       // of the tolerance: the residual of K u = f is not quite that of the system
constexpr double kStalled = 0.5;      // of a residual, that more than remains of after a restart: the end of accuracy
constexpr double kDownward = -1e-10;  // curvature relative to that along the directions of the basis: below rounding

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The unknowns of the system, or a right side: p then holds ratios times largest_forces(), so that all are forces.
struct Mixed {
  Vector u;
  Vector p;

  [[nodiscard]] double dot(const Mixed& other) const { return u.dot(other.u) + p.dot(other.p); }
  void add(double share, const Mixed& other) {
    u += share * other.u;
    p += share * other.p;
  }
};

/// GMRES from zero.
class Gmres {
 public:
  Gmres(const MixedSystem& system, const Vector& forces, int max_iterations)
      : system_(system),
        forces_(forces),
        projection_(Matrix::Zero(max_iterations + 1, max_iterations)),
        curvature_(max_iterations, max_iterations),
        length_(forces.norm()) {
    basis_.push_back({forces / length_, Vector::Zero(system.volumes.stiffness().size())});
  }

  /// Iterates until the residual is `tolerance` of the forces; false: not within the greatest number of iterations.
  [[nodiscard]] bool run(double tolerance) {
    double residual = 1;
    while (residual > tolerance && count_ < projection_.cols()) {
      iterate();
      residual = fit();
    }
    return residual <= tolerance;
  }

  [[nodiscard]] int iterations() const { return int(count_); }
  [[nodiscard]] Vector solution() const { return combined(shares_); }

  /// A direction of negative curvature, scaled as for that of the opposite sign; empty if there is none.
  [[nodiscard]] Vector downhill() const {
    const Matrix all = curvature_.topLeftCorner(count_, count_).selfadjointView<Eigen::Upper>();
    const Vector scale = all.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Matrix> modes(scale.asDiagonal() * all * scale.asDiagonal());
    if (!(modes.eigenvalues()[0] < kDownward)) return {};
    const Vector direction = combined(scale.cwiseProduct(modes.eigenvectors().col(0)));
    return forces_.dot(direction) / -modes.eigenvalues()[0] * direction;
  }

 private:
  void iterate() {
    const VolumePressures& volumes = system_.volumes;
    const Mixed& last = basis_.back();
    Mixed correction;
    correction.p = -volumes.pressures(last.p.cwiseQuotient(volumes.largest_forces()));
    system_.precondition(last.u - system_.volumes.forces(correction.p), correction.u);
    Mixed image;
    system_.multiply(correction.u, image.u);
    corrections_.push_back(correction.u);
    for (Eigen::Index i = 0; i <= count_; ++i) curvature_(i, count_) = corrections_[i].dot(image.u);
    const Vector ratios = volumes.ratios(correction.u);
    image.u += system_.volumes.forces(correction.p - volumes.stiffness().cwiseProduct(ratios));
    image.p = volumes.largest_forces().cwiseProduct(ratios - correction.p.cwiseQuotient(volumes.stiffness()));
    for (Eigen::Index i = 0; i <= count_; ++i) {
      projection_(i, count_) = basis_[i].dot(image);
      image.add(-projection_(i, count_), basis_[i]);
    }
    const double left = std::sqrt(image.dot(image));
    projection_(count_ + 1, count_) = left;
    basis_.push_back({image.u / left, image.p / left});
    ++count_;
  }

  /// Finds the combination of corrections with the least residual; returns that, relative to the forces.
  double fit() {
    const auto projection = projection_.topLeftCorner(count_ + 1, count_);
    const Vector right = length_ * Vector::Unit(count_ + 1, 0);
    shares_ = projection.colPivHouseholderQr().solve(right);
    return (right - projection * shares_).norm() / length_;
  }

  [[nodiscard]] Vector combined(const Vector& shares) const {
    Vector sum = Vector::Zero(forces_.size());
    for (Eigen::Index i = 0; i < shares.size(); ++i) sum += shares[i] * corrections_[i];
    return sum;
  }

  const MixedSystem& system_;
  const Vector& forces_;
  Matrix projection_;  // Hessenberg's matrix
  Matrix curvature_;   // upper triangle: K between corrections
  double length_;      // N, of the forces
  std::vector<Mixed> basis_;
  std::vector<Vector> corrections_;  // of displacements
  Eigen::Index count_ = 0;           // of iterations
  Vector shares_;
};

}  // namespace

Eigen::VectorXd solve_mixed(const MixedSystem& system, const Vector& forces, const StoppingCriterion& end,
                            SolveReport& report, Vector* downhill) {
  ++report.solves;
  Vector u = Vector::Zero(forces.size());
  Vector residual = forces;
  Vector product;
  const double goal = end.tolerance * forces.norm();
  double left = forces.norm();
  for (int iterations = 0; left > goal;) {
    const double before = left;
    if (iterations >= end.max_iterations) break;
    Gmres gmres(system, residual, std::min(kMaxBasis, end.max_iterations - iterations));
    const bool is_found = gmres.run(kMargin * goal / left);
    iterations += gmres.iterations();
    report.iterations += gmres.iterations();
    report.most = std::max(report.most, iterations);
    const Vector down = gmres.downhill();
    if (down.size() > 0) {
      ++report.indefinite;
      if (downhill != nullptr) *downhill = u + down;
      return {};
    }
    u += gmres.solution();
    system.multiply(u, product);
    residual = forces - product;
    left = residual.norm();
    if (left > goal && !(left < kStalled * before)) {
      if (is_found) return u;  // what is left is rounding
      break;
    }
  }
  if (left <= std::max(goal, end.fallback_tolerance * forces.norm())) return u;
  return {};
}

}  // namespace sprung
