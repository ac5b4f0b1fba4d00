#include "core/dynamics/statics/rotated_step.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kAnchor = 1e-6;     // of a brick's weight, for the straight way of a node: holds what no support holds
constexpr double kMaxFlops = 1e9;    // of a factorization, half a second; large compact bodies would take minutes
constexpr double kTolerance = 1e-5;  // of the way between straight and turned

BrickColumns centred(const BrickColumns& corners) { return corners.colwise() - corners.rowwise().mean(); }

/// The rotation vector that explains most of the displacements `u` of corners at `x`, both about their means.
Vec3 rotation_in(const BrickColumns& x, const BrickColumns& u) {
  Mat3 inertia = x.squaredNorm() * Mat3::Identity() - x * x.transpose();
  Vec3 moment = Vec3::Zero();
  for (int c = 0; c < 8; ++c) moment += x.col(c).cross(u.col(c));
  return inertia.ldlt().solve(moment);
}

Mat3 matrix_of(const Vec3& rotation) {
  const double angle = rotation.norm();
  if (angle == 0) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

Points points_of(const Eigen::VectorXd& u) { return Eigen::Map<const Points>(u.data(), u.size() / 3, 3); }

}  // namespace

/// Factorized, or solved by conjugate gradients where that takes too long.
class RotatedStep::System {
 public:
  using Sparse = Eigen::SparseMatrix<double>;

  /// `matrix`: its lower half.
  explicit System(const Sparse& matrix) : matrix_(matrix) {
    factors_.analyzePattern(matrix_);
    is_factorized_ = factors_.cholmod().fl < kMaxFlops;
    if (is_factorized_) {
      factors_.factorize(matrix_);
    } else {
      gradients_.setTolerance(kTolerance);
      gradients_.compute(matrix_);
    }
  }

  /// Empty if the matrix is singular to rounding.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    Eigen::VectorXd found = is_factorized_ ? Eigen::VectorXd(factors_.solve(right)) : gradients_.solve(right);
    const Eigen::ComputationInfo info = is_factorized_ ? factors_.info() : gradients_.info();
    if (info != Eigen::Success) found.resize(0);
    return found;
  }

 private:
  Sparse matrix_;
  bool is_factorized_ = false;
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> factors_;
  Eigen::ConjugateGradient<Sparse, Eigen::Lower, Eigen::IncompleteCholesky<double>> gradients_;
};

RotatedStep::RotatedStep(const Body& body, const Supports& supports) : body_(body), supports_(supports) {}

double RotatedStep::largest_rotation(const Points& positions, const Eigen::VectorXd& u) const {
  const Points moved = points_of(u);
  double largest = 0;
  for (const std::array<int, 8>& nodes : body_.grid.nodes) {
    const BrickColumns x = centred(columns_of(nodes, positions));
    largest = std::max(largest, rotation_in(x, centred(columns_of(nodes, moved))).norm());
  }
  return largest;
}

Points RotatedStep::displaced(const Points& positions, const Eigen::VectorXd& u) {
  const Points moved = points_of(u);
  Points right = Points::Zero(body_.node_count(), 3);  // how far the straight way leaves bricks from their shapes
  for (std::size_t brick = 0; brick < body_.grid.nodes.size(); ++brick) {
    const std::array<int, 8>& nodes = body_.grid.nodes[brick];
    const BrickColumns x = centred(columns_of(nodes, positions));
    const BrickColumns change = centred(columns_of(nodes, moved));
    const Vec3 rotation = rotation_in(x, change);
    BrickColumns shape = x + change;
    for (int c = 0; c < 8; ++c) shape.col(c) -= rotation.cross(x.col(c));
    const BrickColumns left = body_.stiffness_scale[brick] * (matrix_of(rotation) * shape - x - change);
    for (int c = 0; c < 8; ++c) right.row(nodes[c]) += left.col(c).transpose();
  }
  for (Eigen::Index i = 0; i < right.size(); ++i) {
    if (supports_.fixed[std::size_t(i)]) right.data()[i] = 0;
  }
  prepare();
  Points after = positions + moved;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd further = systems_[axis]->solve(right.col(axis));
    if (further.size() == 0) return {};
    after.col(axis) += further;
  }
  return after;
}

void RotatedStep::prepare() {
  if (held_ == supports_.fixed) return;
  held_ = supports_.fixed;
  systems_ = {};
  for (int axis = 0; axis < 3; ++axis) systems_[axis] = system_along(axis);
}

/// The derivative of sum over bricks of w |y - mean(y) - shape|^2, over two, by y, with rows of held nodes like those
/// of the identity.
std::shared_ptr<RotatedStep::System> RotatedStep::system_along(int axis) const {
  const auto is_held = [&](int node) { return supports_.fixed[3 * std::size_t(node) + axis]; };
  for (int other = 0; other < axis; ++other) {
    bool is_same = systems_[other] != nullptr;
    for (int node = 0; is_same && node < body_.node_count(); ++node) {
      is_same = is_held(node) == supports_.fixed[3 * std::size_t(node) + other];
    }
    if (is_same) return systems_[other];
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t(body_.node_count()) + 36 * body_.grid.nodes.size());
  for (int node = 0; node < body_.node_count(); ++node) entries.emplace_back(node, node, is_held(node) ? 1 : kAnchor);
  for (std::size_t brick = 0; brick < body_.grid.nodes.size(); ++brick) {
    const double weight = body_.stiffness_scale[brick];
    for (const int row : body_.grid.nodes[brick]) {
      for (const int column : body_.grid.nodes[brick]) {
        if (column > row || is_held(row) || is_held(column)) continue;
        entries.emplace_back(row, column, weight * (row == column ? 7.0 / 8 : -1.0 / 8));
      }
    }
  }
  System::Sparse matrix(body_.node_count(), body_.node_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return std::make_shared<System>(matrix);
}

}  // namespace sprung
