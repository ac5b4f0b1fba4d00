#include "core/motion/stiffness_matrix.h"

#include <tbb/parallel_for.h>

#include "core/body/brick_hessian.h"

namespace sprung {

FreeDofs::FreeDofs(const Supports& supports) {
  index.reserve(supports.fixed.size());
  for (const bool fixed : supports.fixed) index.push_back(fixed ? -1 : count++);
}

Eigen::VectorXd FreeDofs::gather(const Eigen::VectorXd& all) const {
  Eigen::VectorXd free(count);
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] >= 0) free[index[i]] = all[static_cast<int>(i)];
  }
  return free;
}

Eigen::VectorXd FreeDofs::scatter(const Eigen::VectorXd& free) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<int>(index.size()));
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] >= 0) all[static_cast<int>(i)] = free[index[i]];
  }
  return all;
}

Eigen::SparseMatrix<double> stiffness_matrix(const Body& body, const FreeDofs& dofs, bool definite) {
  const auto bricks = static_cast<std::size_t>(body.grid.brick_count());
  std::vector<BrickMatrix> hessians(bricks);
  tbb::parallel_for(std::size_t{0}, bricks, [&](std::size_t brick) {
    const BrickMatrix hessian = body_brick_hessian(body, brick);
    hessians[brick] = definite ? without_negative_curvature(hessian) : hessian;
  });
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(300 * bricks);
  for (std::size_t brick = 0; brick < bricks; ++brick) {
    const auto& nodes = body.grid.nodes[brick];
    for (int b = 0; b < 24; ++b) {
      const int column = dofs.index[static_cast<std::size_t>(3 * nodes[static_cast<std::size_t>(b / 3)] + b % 3)];
      if (column < 0) continue;
      for (int a = 0; a < 24; ++a) {
        const int row = dofs.index[static_cast<std::size_t>(3 * nodes[static_cast<std::size_t>(a / 3)] + a % 3)];
        if (row >= column) entries.emplace_back(row, column, hessians[brick](a, b));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(dofs.count, dofs.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace sprung
