#include "core/dynamics/linear/stiffness.h"

#include <tbb/parallel_for.h>

#include "core/body/brick_hessian.h"
#include "core/body/brick_model.h"
#include "core/dynamics/linear/multigrid_kernels.h"

namespace sprung {

void add_point_stiffness(const PointStiffness& point, BrickMatrix& matrix) {
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      matrix.block<3, 3>(3 * a, 3 * b) += point.weights[a] * point.weights[b] * point.stiffness;
    }
  }
}

void add_point_product(const Body& body, const PointStiffness& point, const Eigen::VectorXd& x,
                       Eigen::VectorXd& product) {
  const auto& nodes = body.grid.nodes[point.brick];
  Vec3 moved = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c) moved += point.weights[c] * x.segment<3>(3 * nodes[c]);
  const Vec3 force = point.stiffness * moved;
  for (std::size_t c = 0; c < 8; ++c) product.segment<3>(3 * nodes[c]) += point.weights[c] * force;
}

namespace {

BrickMatrix brick_damping(const Body& body, std::size_t brick, const StepTerms& terms) {
  return brick_model(body.model).damping(body, brick, at_corners(body, brick, terms.damping_positions));
}

}  // namespace

FreeDofs::FreeDofs(const Supports& supports) {
  index.reserve(supports.fixed.size());
  for (const bool fixed : supports.fixed) index.push_back(fixed ? -1 : count++);
}

Eigen::VectorXd FreeDofs::gather(const Eigen::VectorXd& all) const {
  Eigen::VectorXd free(count);
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] >= 0) free[index[i]] = all[i];
  }
  return free;
}

Eigen::VectorXd FreeDofs::scatter(const Eigen::VectorXd& free) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(isize(index));
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] >= 0) all[i] = free[index[i]];
  }
  return all;
}

Eigen::SparseMatrix<double> stiffness_matrix(const Body& body, const FreeDofs& dofs, bool definite,
                                             const StepTerms& terms) {
  const std::size_t bricks = body.grid.brick_count();
  std::vector<BrickMatrix> hessians(bricks);
  tbb::parallel_for(std::size_t{0}, bricks, [&](std::size_t brick) {
    const BrickMatrix hessian = body_brick_hessian(body, brick, definite);
    hessians[brick] = definite ? without_negative_curvature(hessian) : hessian;
    if (terms.damping != 0) hessians[brick] += terms.damping * brick_damping(body, brick, terms);
  });
  for (const PointStiffness& point : terms.points) {
    add_point_stiffness(point, hessians[point.brick]);
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(300 * bricks);
  for (std::size_t brick = 0; brick < bricks; ++brick) {
    const auto& nodes = body.grid.nodes[brick];
    for (int b = 0; b < 24; ++b) {
      const int column = dofs.index[3 * nodes[b / 3] + b % 3];
      if (column < 0) continue;
      for (int a = 0; a < 24; ++a) {
        const int row = dofs.index[3 * nodes[a / 3] + a % 3];
        if (row >= column) entries.emplace_back(row, column, hessians[brick](a, b));
      }
    }
  }
  for (std::size_t i = 0; i < dofs.index.size(); ++i) {
    if (dofs.index[i] < 0 || terms.mass_factor == 0) continue;
    entries.emplace_back(dofs.index[i], dofs.index[i], terms.mass_factor * body.masses[i / 3]);
  }
  Eigen::SparseMatrix<double> matrix(dofs.count, dofs.count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

namespace {

constexpr int kBlocksPerTask = 32;

/// `product`: of a brick, for the displacements of its corners.
template <class Product>
void multiply_bricks(const Body& body, const Eigen::VectorXd& u, const Product& product, double* products) {
  tbb::parallel_for(std::size_t{0}, body.grid.nodes.size(), [&](std::size_t brick) {
    BrickVector moves;
    for (int c = 0; c < 8; ++c) {
      moves.segment<3>(Eigen::Index{3} * c) = u.segment<3>(Eigen::Index{3} * body.grid.nodes[brick][c]);
    }
    Eigen::Map<BrickVector>(products + 24 * brick) = product(brick, moves);
  });
}

void multiply_springs(const Body& body, const Eigen::VectorXd& u, double* products) {
  const BlockInput block = block_input(body);
  const int blocks = (body.grid.brick_count() + kBricksPerBlock - 1) / kBricksPerBlock;
  tbb::parallel_for(tbb::blocked_range<int>(0, blocks, kBlocksPerTask), [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      multigrid::kernels().stiffness_product(block, u.data(), i * kBricksPerBlock, products);
    }
  });
}

}  // namespace

void multiply_stiffness(const Body& body, const Eigen::VectorXd& u, ProductWorkspace& workspace,
                        Eigen::VectorXd& product) {
  if (body.model == Model::kCalibrated) return workspace.springs.multiply(body, u, product);
  double* products = workspace.sums.room(body.grid);
  if (has_springs(body.model)) {
    multiply_springs(body, u, products);
  } else {
    const BrickModel& model = brick_model(body.model);
    multiply_bricks(
        body, u,
        [&](std::size_t brick, const BrickVector& moves) {
          return model.product(body, brick, at_corners(body, brick, body.positions), moves);
        },
        products);
  }
  product.resize(u.size());
  workspace.sums.sum(product.data());
}

void multiply_damping(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                      ProductWorkspace& workspace, Eigen::VectorXd& product) {
  if (has_tiles(body.model)) return workspace.springs.multiply_along(body, positions, factor, u, product);
  const BrickModel& model = brick_model(body.model);
  multiply_bricks(
      body, u,
      [&](std::size_t brick, const BrickVector& moves) {
        return model.damping_product(body, brick, at_corners(body, brick, positions), moves);
      },
      workspace.sums.room(body.grid));
  product.resize(u.size());
  workspace.sums.sum(product.data());
  product *= factor;
}

}  // namespace sprung
