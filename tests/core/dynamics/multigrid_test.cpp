#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/body/brick_model.h"
#include "core/body/forces.h"
#include "core/bricks/fill_solid.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/dynamics/linear/multigrid_level.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/bodies.h"
#include "tests/support/linear_problems.h"

namespace sprung {
namespace {

using test::bracket;
using test::cantilever;
using test::Problem;
using test::solve;
using test::test_material;

void expect_same(const Problem& problem, double error) {
  const auto direct = make_direct_solver();
  const auto multigrid = make_multigrid_solver();
  const Eigen::VectorXd right = solve(*direct, problem, 0);
  const Eigen::VectorXd found = solve(*multigrid, problem, 1e-11);
  ASSERT_EQ(found.size(), right.size());
  EXPECT_LT((found - right).norm(), error * right.norm());
  EXPECT_LE(multigrid->report().most, 70);  // to 1e-11
}

TEST(Multigrid, EqualsTheDirectSolver) {
  expect_same(cantilever(8, 0.3), 1e-8);  // one level
  expect_same(cantilever(24, 0.3), 1e-8);
  Problem slotted(bracket(15));
  for (std::size_t i = 0; i < slotted.body.stiffness_scale.size(); i += 3) slotted.body.stiffness_scale[i] *= 100;
  build_tiles(slotted.body);
  expect_same(slotted, 1e-8);
  expect_same(Problem(bracket(12), 0.3, Model::kFem), 1e-8);
}

TEST(Multigrid, EqualsTheDirectSolverFarFromRest) {
  Problem problem = test::shaken_bracket(0.3, 0.1, 1e4);
  // Half inverted.
  const auto& nodes = problem.body.grid.nodes[60];
  for (const int corner : {1, 3, 5, 7}) {
    problem.body.positions(nodes[corner], 0) -= 0.8 * problem.body.grid.brick_size;
  }
  const auto direct = make_direct_solver();
  if (!direct->linearize(problem.body, problem.supports, false, problem.terms)) problem.terms.mass_factor = 1e7;
  expect_same(problem, 1e-8);
}

TEST(Multigrid, SaysThatAMatrixIsNotPositiveDefinite) {
  Problem problem = cantilever(16, 0.3);
  problem.body.positions.col(0) *= 0.5;  // compressed lengthwise: it would buckle
  const auto direct = make_direct_solver();
  EXPECT_FALSE(direct->linearize(problem.body, problem.supports, false, problem.terms));
  const auto multigrid = make_multigrid_solver();
  EXPECT_FALSE(multigrid->linearize(problem.body, problem.supports, false, problem.terms));
  EXPECT_GT(solve(*multigrid, problem, 1e-4, true).size(), 0);
}

/// Solves by plain conjugate gradients; fills `downhill`.
Eigen::VectorXd solve_dense(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& forces, Eigen::VectorXd& downhill) {
  SolveReport report;
  return conjugate_gradients(
      forces, {.tolerance = 1e-12, .max_iterations = 100},
      [&](const Eigen::VectorXd& x, Eigen::VectorXd& product) { product = matrix * x; },
      [](const Eigen::VectorXd& residual, Eigen::VectorXd& answer) { answer = residual; }, report, &downhill);
}

// Descent directions of 1/2 x.A x - f.x, for random matrices with one negative eigenvalue.
TEST(ConjugateGradients, LeadDownhillWhereAMatrixIsNotPositiveDefinite) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(12, 12, [&] { return normal(random); });
    const Eigen::MatrixXd axes = any.householderQr().householderQ();
    Eigen::VectorXd eigenvalues = Eigen::VectorXd::LinSpaced(12, 1, 12);
    Eigen::VectorXd downhill;
    const Eigen::VectorXd forces = any.col(0);
    const Eigen::MatrixXd positive = axes * eigenvalues.asDiagonal() * axes.transpose();
    EXPECT_LT((positive * solve_dense(positive, forces, downhill) - forces).norm(), 1e-9);
    EXPECT_EQ(downhill.size(), 0);
    eigenvalues[0] = -0.5;
    const Eigen::MatrixXd matrix = axes * eigenvalues.asDiagonal() * axes.transpose();
    EXPECT_EQ(solve_dense(matrix, forces, downhill).size(), 0) << trial;
    ASSERT_EQ(downhill.size(), 12) << trial;
    EXPECT_GT(downhill.dot(forces), 0) << trial;
    EXPECT_LT(0.5 * downhill.dot(matrix * downhill) - forces.dot(downhill), 0) << trial;
  }
}

TEST(Multigrid, IterationsDoNotGrowWithTheBody) {
  for (const double poisson : {0.0, 0.3, 0.49}) {
    std::vector<long> iterations;
    for (const int n : {32, 64}) {
      const auto multigrid = make_multigrid_solver();
      EXPECT_GT(solve(*multigrid, cantilever(n, poisson), 1e-6).size(), 0);
      iterations.push_back(multigrid->report().iterations);
    }
    EXPECT_LE(iterations[1], iterations[0] + 4) << poisson;
    EXPECT_LT(iterations[1], 25) << poisson;
  }
}

TEST(Multigrid, ThinPartsAndTwoMaterialsTakeFewIterations) {
  const auto count = [](const Problem& problem) {
    const auto multigrid = make_multigrid_solver();
    EXPECT_GT(solve(*multigrid, problem, 1e-6).size(), 0);
    return multigrid->report().iterations;
  };
  EXPECT_LT(count(Problem(make_box_grid({32, 1, 32}, 0.01))), 25);
  EXPECT_LT(count(Problem(bracket(24))), 25);
  Problem lumps(make_box_grid({24, 8, 12}, 0.01));
  for (int i = 0; i < lumps.body.grid.brick_count(); ++i) {
    const Eigen::Vector3i lump = lumps.body.grid.cells[i] / 4;
    if (lump.sum() % 2 == 1) lumps.body.stiffness_scale[i] *= 1000;
  }
  build_tiles(lumps.body);
  EXPECT_LT(count(lumps), 25);
}

/// Octopuses have thin arms, and bricks cut to slivers whose stiffness is negligible next to whole ones.
TEST(Multigrid, CutBricksTakeFewIterations) {
  for (const double poisson : {0.3, 0.45, 0.49}) {
    const Problem problem(test::cut_bricks("octopus", 32), poisson);
    const auto multigrid = make_multigrid_solver();
    EXPECT_GT(solve(*multigrid, problem, 1e-6).size(), 0);
    EXPECT_LT(multigrid->report().iterations, 25) << poisson;
  }
}

/// Their bending stiffness is so low that hardly any rounding error is small compared with it.
TEST(Multigrid, SlenderBeamsTakeFewIterations) {
  const auto count = [](const Eigen::Vector3i& counts) {
    Problem problem(make_box_grid(counts, 0.01));
    problem.supports = Supports(problem.body.node_count());
    for (int node = 0; node < problem.body.node_count(); ++node) {
      if (problem.body.grid.lattice[node].x() == 0) problem.supports.fix(node);
    }
    const auto multigrid = make_multigrid_solver();
    EXPECT_GT(solve(*multigrid, problem, 1e-6).size(), 0);
    return multigrid->report().iterations;
  };
  EXPECT_LT(count({128, 4, 4}), 16);
  EXPECT_LT(count({256, 2, 2}), 25);
}

TEST(Multigrid, SameBitsForAnyNumberOfThreads) {
  const Problem problem(bracket(24));
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto multigrid = make_multigrid_solver();
    return solve(*multigrid, problem, 1e-6);
  };
  const Eigen::VectorXd one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(5));
}

/// Pulls of symmetric matrices: the first corner's block and the sum of the others' are symmetric too.
void make_symmetric(float* pull) {
  const auto at = [pull](std::size_t corner, std::size_t row, std::size_t column, std::size_t lane) -> float& {
    return pull[(3 * (3 * corner + row) + column) * multigrid::kLanes + lane];
  };
  for (std::size_t lane = 0; lane < multigrid::kLanes; ++lane) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < r; ++c) {
        double skew = 0;
        for (std::size_t corner = 1; corner < 8; ++corner) {
          skew += double(at(corner, r, c, lane) - at(corner, c, r, lane));
        }
        at(0, r, c, lane) = float(double(at(0, c, r, lane)) - skew);
      }
    }
  }
}

/// All bricks; the unused slots of the last block are left empty.
void fill_at_random(multigrid::Level& level, int bricks) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1, 1);
  for (int block = 0; block < level.block_count(); ++block) {
    float* pull = level.add_pull(block);
    for (std::size_t i = 0; i < kAnchoredSize * multigrid::kLanes; ++i) level.matrix(block)[i] = value(random);
    for (std::size_t i = 0; i < multigrid::kPullSize * multigrid::kLanes; ++i) pull[i] = value(random);
    make_symmetric(pull);
  }
  const int last = level.block_count() - 1;
  for (int lane = bricks % multigrid::kLanes; lane > 0 && lane < multigrid::kLanes; ++lane) {
    const auto l = std::size_t(lane);
    for (std::size_t i = 0; i < kAnchoredSize; ++i) level.matrix(last)[i * multigrid::kLanes + l] = 0;
    for (std::size_t i = 0; i < multigrid::kPullSize; ++i) level.add_pull(last)[i * multigrid::kLanes + l] = 0;
  }
}

/// Displacements of the fine nodes from those of the coarse ones.
Eigen::MatrixXd fine_from_coarse(const multigrid::Layout& fine, const multigrid::Layout& coarse) {
  const multigrid::Interpolation& hang = fine.to_coarse;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * fine.node_count, 3 * coarse.node_count);
  for (int node = 0; node < fine.node_count; ++node) {
    const auto n = std::size_t(node);
    for (std::size_t i = 0; i < hang.counts[n]; ++i) {
      matrix.block<3, 3>(3 * node, 3 * hang.coarse_nodes[n][i]) += Mat3::Identity() / hang.counts[n];
    }
  }
  return matrix;
}

Eigen::MatrixXd whole(const multigrid::Level& level) {
  const Eigen::MatrixXd lower = level.sparse();
  return lower.selfadjointView<Eigen::Lower>();
}

/// The coarse bricks' sum is P^T A P, P by the nodes' places.
TEST(MultigridLevel, CoarseBricksAreGalerkins) {
  const BrickGrid grid = bracket(6);
  const std::vector<multigrid::Layout> layouts = multigrid::make_hierarchy(grid, {.max_nodes = 20});
  ASSERT_GE(layouts.size(), 2U);
  multigrid::Level fine(layouts[0]);
  multigrid::Level coarse(layouts[1]);
  fill_at_random(fine, grid.brick_count());
  coarse.coarsen(fine);
  const Eigen::MatrixXd interpolation = fine_from_coarse(layouts[0], layouts[1]);
  const Eigen::MatrixXd expected = interpolation.transpose() * whole(fine) * interpolation;
  EXPECT_LT((whole(coarse) - expected).norm(), 1e-5 * expected.norm());
}

TEST(MultigridLevel, MultipliesLikeItsDenseMatrix) {
  const BrickGrid grid = bracket(6);
  const std::vector<multigrid::Layout> layouts = multigrid::make_hierarchy(grid, {.max_nodes = 20});
  multigrid::Level level(layouts[0]);
  fill_at_random(level, grid.brick_count());
  level.prepare_smoother(1);
  const Eigen::VectorXd x = Eigen::VectorXd::Random(3 * layouts[0].node_count);
  const Eigen::VectorXd expected = whole(level) * x;
  Eigen::VectorXd product;
  level.multiply(x, product);
  EXPECT_LT((product - expected).norm(), 1e-6 * expected.norm());
  const Eigen::VectorXf in_single = x.cast<float>();
  Eigen::VectorXf single;
  level.multiply(in_single, single);
  EXPECT_LT((single.cast<double>() - expected).norm(), 1e-5 * expected.norm());
}

TEST(MultigridHierarchy, PartsDividedByAGapStayFree) {
  BrickGrid grid;  // a comb: teeth one brick wide, one brick apart, on a back
  grid.brick_size = 0.01;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 15; ++x) {
      if (y == 0 || x % 2 == 0) grid.cells.emplace_back(x, y, 0);
    }
  }
  grid.fill.assign(grid.cells.size(), 1.0);
  number_nodes(grid);
  const std::vector<multigrid::Layout> layouts = multigrid::make_hierarchy(grid, {.max_nodes = 1});
  int tips = 0;  // coarse bricks at the top: one for each of the eight teeth
  for (const Eigen::Vector3i& cell : layouts[1].cells) tips += cell.y() == 3 ? 1 : 0;
  EXPECT_EQ(tips, 8);
  tips = 0;
  for (const Eigen::Vector3i& cell : layouts[2].cells) tips += cell.y() == 1 ? 1 : 0;
  EXPECT_EQ(tips, 8);
  EXPECT_LE(layouts.back().bricks.size(), 2U);
}

TEST(MultigridHierarchy, CoarsensSolidPartsFurtherThanThinOnes) {
  const multigrid::LastLevel last{.max_nodes = 2000, .max_flops = 1e7};
  EXPECT_EQ(multigrid::make_hierarchy(make_box_grid({400, 1, 1}, 0.01), last).size(), 1U);   // 1604 nodes
  EXPECT_GT(multigrid::make_hierarchy(make_box_grid({11, 11, 11}, 0.01), last).size(), 1U);  // 1728
}

TEST(MultigridKernels, AllInstructionSetsGiveTheSameBits) {
  std::mt19937 random(11);
  Problem problem(bracket(9), 0.3, Model::kTensile);
  test::shake(problem.body, 0.1, random);
  const BlockInput input = block_input(problem.body);
  const EdgeCoupling coupling = edge_coupling(problem.body.law);
  const auto results = [&](const multigrid::Kernels& kernels) {
    std::vector<float> matrix(kAnchoredSize * multigrid::kLanes);
    kernels.stiffness_matrices(input, coupling, 1.3, 16, matrix.data());
    std::vector<float> forces(24 * multigrid::kLanes);
    const Eigen::VectorXf x = problem.forces.cast<float>();
    const multigrid::LevelBlock block{.matrix = matrix.data(), .pull = nullptr, .nodes = input.nodes, .count = 16};
    kernels.apply(block, x.data(), forces.data());
    matrix.insert(matrix.end(), forces.begin(), forces.end());
    std::vector<double> products(24 * std::size_t(input.brick_count));
    kernels.stiffness_product(input, problem.forces.data(), 8, products.data());
    for (const double value : products) matrix.push_back(float(value));
    return matrix;
  };
  const auto all = multigrid::all_kernels();
  for (const multigrid::Kernels& kernels : all) EXPECT_EQ(results(kernels), results(all.front()));
}

}  // namespace
}  // namespace sprung
