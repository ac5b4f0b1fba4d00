#include "core/motion/stiffness_product.h"

#include <tbb/parallel_for.h>

#include "core/body/forces.h"
#include "core/motion/multigrid/kernels.h"

namespace sprung {
namespace {

constexpr int kBlocksPerTask = 32;

void multiply_hexahedra(const Body& body, double factor, const Eigen::VectorXd& u, double* products) {
  tbb::parallel_for(0, body.grid.brick_count(), [&](int brick) {
    const auto b = static_cast<std::size_t>(brick);
    Eigen::Matrix<double, 24, 1> moves;
    for (int c = 0; c < 8; ++c) {
      moves.segment<3>(Eigen::Index{3} * c) =
          u.segment<3>(Eigen::Index{3} * body.grid.nodes[b][static_cast<std::size_t>(c)]);
    }
    Eigen::Map<Eigen::Matrix<double, 24, 1>> product(products + 24 * b);
    product = factor * body.stiffness_scale[b] * (body.small_strain_stiffness * moves);
  });
}

int block_count(const Body& body) { return (body.grid.brick_count() + kBricksPerBlock - 1) / kBricksPerBlock; }

/// Calls visit(first brick) for each block, in parallel.
template <class Visit>
void each_block(const Body& body, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<int>(0, block_count(body), kBlocksPerTask),
                    [&](const tbb::blocked_range<int>& range) {
                      for (int block = range.begin(); block < range.end(); ++block) visit(block * kBricksPerBlock);
                    });
}

}  // namespace

void find_directions(const Body& body, const Points& positions, std::vector<double>& directions) {
  if (body.small_strain_stiffness.size() > 0) return;
  directions.resize(static_cast<std::size_t>(block_count(body)) * multigrid::kDirectionsOfBlock);
  BlockInput block = block_input(body);
  block.positions = positions.data();
  each_block(body, [&](int first) { multigrid::kernels().directions(block, first, directions.data()); });
}

void multiply_stiffness(const Body& body, const StiffnessFactors& factors, const std::vector<double>& directions,
                        const Eigen::VectorXd& u, CornerSums& sums, Eigen::VectorXd& product) {
  double* corner_products = sums.room(body.grid);
  if (body.small_strain_stiffness.size() > 0) {
    multiply_hexahedra(body, factors.stiffness + factors.damping, u, corner_products);
  } else {
    const multigrid::ProductInput input{.block = block_input(body),
                                        .moves = u.data(),
                                        .stiffness = factors.stiffness,
                                        .damping = factors.damping,
                                        .directions = directions.data()};
    each_block(body, [&](int first) { multigrid::kernels().stiffness_product(input, first, corner_products); });
  }
  product.resize(u.size());
  sums.sum(product.data());
}

}  // namespace sprung
