#include "core/motion/stiffness_matrix.h"

#include <tbb/parallel_for.h>

#include "core/body/brick_damping.h"
#include "core/body/brick_hessian.h"
#include "core/motion/point_forces.h"

namespace sprung {
namespace {

/// A brick's stiffness along its springs where the damping is measured, column by column.
BrickMatrix brick_stiffness_along(const Body& body, std::size_t brick, const StepTerms& terms) {
  const double scale = body.stiffness_scale[brick];
  if (body.is_hexahedral()) return scale * body.small_strain_stiffness;
  CornerVectors<double> x{};
  for (std::size_t i = 0; i < 24; ++i) {
    x[i] = terms.damping_positions(body.grid.nodes[brick][i / 3], static_cast<int>(i % 3));
  }
  const auto directions = spring_directions(body.grid.brick_size, x);
  BrickMatrix matrix;
  for (int column = 0; column < 24; ++column) {
    CornerVectors<double> unit{};
    unit[static_cast<std::size_t>(column)] = 1;
    CornerVectors<double> product{};
    damping_product(body.law, directions, unit, product);
    matrix.col(column) = scale * Eigen::Map<const Eigen::Matrix<double, 24, 1>>(product.data());
  }
  return matrix;
}

}  // namespace

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

Eigen::SparseMatrix<double> stiffness_matrix(const Body& body, const FreeDofs& dofs, bool definite,
                                             const StepTerms& terms) {
  const auto bricks = static_cast<std::size_t>(body.grid.brick_count());
  std::vector<BrickMatrix> hessians(bricks);
  tbb::parallel_for(std::size_t{0}, bricks, [&](std::size_t brick) {
    const BrickMatrix hessian = body_brick_hessian(body, brick);
    hessians[brick] = definite ? without_negative_curvature(hessian) : hessian;
    if (terms.damping != 0) hessians[brick] += terms.damping * brick_stiffness_along(body, brick, terms);
  });
  for (const PointStiffness& point : terms.points) {
    add_point_stiffness(point, hessians[static_cast<std::size_t>(point.brick)]);
  }
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
  for (std::size_t i = 0; i < dofs.index.size(); ++i) {
    if (dofs.index[i] < 0 || terms.mass_factor == 0) continue;
    entries.emplace_back(dofs.index[i], dofs.index[i],
                         terms.mass_factor * body.masses[static_cast<Eigen::Index>(i / 3)]);
  }
  Eigen::SparseMatrix<double> matrix(dofs.count, dofs.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace sprung
