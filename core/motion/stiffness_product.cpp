#include "core/motion/stiffness_product.h"

#include <tbb/parallel_for.h>

#include "core/motion/multigrid/kernels.h"

namespace sprung {
namespace {

constexpr int kBlocksPerTask = 32;

void multiply_hexahedra(const Body& body, const Eigen::VectorXd& u, double* products) {
  tbb::parallel_for(0, body.grid.brick_count(), [&](int brick) {
    const auto b = static_cast<std::size_t>(brick);
    Eigen::Matrix<double, 24, 1> moves;
    for (int c = 0; c < 8; ++c) {
      moves.segment<3>(Eigen::Index{3} * c) =
          u.segment<3>(Eigen::Index{3} * body.grid.nodes[b][static_cast<std::size_t>(c)]);
    }
    Eigen::Map<Eigen::Matrix<double, 24, 1>> product(products + 24 * b);
    product = body.stiffness_scale[b] * (body.small_strain_stiffness * moves);
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
  double* products = workspace.sums.room(body.grid);
  if (body.is_hexahedral()) {
    multiply_hexahedra(body, u, products);
  } else {
    multiply_springs(body, u, products);
  }
  product.resize(u.size());
  workspace.sums.sum(product.data());
}

void multiply_damping(const Body& body, const Points& positions, double factor, const Eigen::VectorXd& u,
                      ProductWorkspace& workspace, Eigen::VectorXd& product) {
  if (body.is_hexahedral()) {
    multiply_stiffness(body, u, workspace, product);
    product *= factor;
  } else {
    workspace.springs.multiply_along(body, positions, factor, u, product);
  }
}

}  // namespace sprung
