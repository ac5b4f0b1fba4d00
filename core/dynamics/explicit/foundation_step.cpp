#include "core/dynamics/explicit/foundation_step.h"

#include <algorithm>

namespace sprung {

FoundationStep::FoundationStep(const SoftBody& body, double elapsed) : springs_(body.supports_after(elapsed)) {
  for (const SpringSupport& support : springs_) {
    const auto& nodes = body.grid.nodes[support.spring.brick];
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  std::vector<Eigen::Triplet<double>> entries;
  for (const SpringSupport& support : springs_) {
    std::array<int, 8>& rows = corners_.emplace_back();
    for (int corner = 0; corner < 8; ++corner) {
      const int node = body.grid.nodes[support.spring.brick][corner];
      rows[corner] = int(std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
    }
    for (int a = 0; a < 8; ++a) {
      for (int b = 0; b < 8; ++b) {
        const Mat3 block = support.spring.weights[a] * support.spring.weights[b] * support.spring.stiffness;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) entries.emplace_back(3 * rows[a] + i, 3 * rows[b] + j, block(i, j));
        }
      }
    }
  }
  stiffness_.resize(3 * isize(nodes_), 3 * isize(nodes_));
  stiffness_.setFromTriplets(entries.begin(), entries.end());
}

void FoundationStep::factorize(const SoftBody& body, double kick_step) {
  if (kick_step == factorized_for_) return;
  Eigen::SparseMatrix<double> matrix = kick_step * stiffness_;
  for (int row = 0; row < isize(nodes_); ++row) {
    for (int axis = 0; axis < 3; ++axis) matrix.coeffRef(3 * row + axis, 3 * row + axis) += body.masses[nodes_[row]];
  }
  if (factorized_for_ == 0) system_.analyzePattern(matrix);
  system_.factorize(matrix);
  factorized_for_ = kick_step;
}

void FoundationStep::apply(SoftBody& body, double kick, double step) {
  if (springs_.empty()) return;
  factorize(body, kick * step);
  Eigen::VectorXd momentum(3 * isize(nodes_));
  for (int row = 0; row < isize(nodes_); ++row) {
    momentum.segment<3>(3 * row) = body.masses[nodes_[row]] * body.velocities.row(nodes_[row]);
  }
  const Points displacements = body.positions(nodes_, Eigen::all) - body.rest_positions(nodes_, Eigen::all);
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    const SpringSupport& support = springs_[i];
    const Vec3 stretch = stretch_of(support, corners_[i], displacements) + step * support.velocity;
    const Vec3 impulse = kick * support.spring.stiffness * stretch;
    for (int c = 0; c < 8; ++c) momentum.segment<3>(3 * corners_[i][c]) += support.spring.weights[c] * impulse;
  }
  const Eigen::VectorXd velocities = system_.solve(momentum);
  for (int row = 0; row < isize(nodes_); ++row) {
    body.velocities.row(nodes_[row]) = velocities.segment<3>(3 * row).transpose();
  }
}

void FoundationStep::pass(double step) {
  for (SpringSupport& support : springs_) support.displacement += step * support.velocity;
}

}  // namespace sprung
