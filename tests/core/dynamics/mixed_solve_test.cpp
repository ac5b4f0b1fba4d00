#include "core/dynamics/linear/mixed_solve.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/body/forces.h"
#include "core/dynamics/linear/stiffness.h"
#include "tests/support/linear_problems.h"

namespace sprung {
namespace {

using test::bracket;
using test::cantilever;
using test::cut_bricks;
using test::Problem;
using test::solve;

constexpr double kNearlyIncompressible = 0.4999;

void expect_same_as_direct(const Problem& problem) {
  ASSERT_TRUE(VolumePressures::help(problem.body));
  const auto direct = make_direct_solver();
  const auto mixed = make_mixed_solver();
  const Eigen::VectorXd right = solve(*direct, problem, 0);
  const Eigen::VectorXd found = solve(*mixed, problem, 1e-11);
  ASSERT_EQ(found.size(), right.size());
  EXPECT_LT((found - right).norm(), 1e-7 * right.norm());
}

TEST(MixedSolve, EqualsTheDirectSolver) {
  expect_same_as_direct(cantilever(24, kNearlyIncompressible));
  Problem slotted(bracket(15), kNearlyIncompressible);
  for (std::size_t i = 0; i < slotted.body.stiffness_scale.size(); i += 3) slotted.body.stiffness_scale[i] *= 100;
  build_tiles(slotted.body);
  expect_same_as_direct(slotted);
}

TEST(MixedSolve, EqualsTheDirectSolverFarFromRest) {
  expect_same_as_direct(test::shaken_bracket(kNearlyIncompressible, 0.03, 1e8));
}

/// Fewer than half of those that conjugate gradients take, and at a ratio of 0.499 as few as any other body.
TEST(MixedSolve, TakesFewIterationsNearIncompressibility) {
  const auto iterations = [](LinearSolver& system, const Problem& problem) {
    EXPECT_GT(solve(system, problem, 1e-6).size(), 0);
    return system.report().iterations;
  };
  for (const double poisson : {0.499, kNearlyIncompressible}) {
    Problem plate(make_box_grid({48, 2, 48}, 0.01), poisson);
    Problem cube(make_box_grid({16, 16, 16}, 0.01), poisson);
    for (const Problem& problem : {cantilever(32, poisson), cube, plate, Problem(bracket(24), poisson),
                                   Problem(cut_bricks("octopus", 32), poisson)}) {
      const long mixed = iterations(*make_mixed_solver(), problem);
      EXPECT_LE(mixed, poisson < 0.4995 ? 40 : 60) << problem.body.grid.brick_count();
      if (poisson < 0.4995 || problem.body.grid.brick_count() > 4096) continue;
      EXPECT_LT(2 * mixed, iterations(*make_multigrid_solver(1000), problem)) << problem.body.grid.brick_count();
    }
  }
}

/// Beams shortened by 8 %, which would buckle: directions along which the potential decreases.
TEST(MixedSolve, LeadsDownhillWhereTheStiffnessIsNotPositiveDefinite) {
  Problem problem(make_box_grid({48, 4, 4}, 0.01), kNearlyIncompressible);
  problem.supports = Supports(problem.body.node_count());
  for (int node = 0; node < problem.body.node_count(); ++node) {
    if (problem.body.grid.lattice[node].x() % 48 == 0) problem.supports.fix(node);
  }
  const double across = std::pow(0.92, -0.5);
  problem.body.positions = problem.body.rest_positions * Vec3(0.92, across, across).asDiagonal();
  const auto mixed = make_mixed_solver();
  EXPECT_FALSE(make_direct_solver()->linearize(problem.body, problem.supports, false, problem.terms));
  ASSERT_TRUE(mixed->linearize(problem.body, problem.supports, false, problem.terms));
  EXPECT_EQ(mixed->solve(problem.forces, 1e-6).size(), 0);
  EXPECT_EQ(mixed->report().indefinite, 1);
  const Eigen::VectorXd downhill = mixed->downhill();
  ASSERT_EQ(downhill.size(), problem.forces.size());
  ProductWorkspace workspace;
  Eigen::VectorXd product;
  multiply_stiffness(problem.body, downhill, workspace, product);
  EXPECT_GT(downhill.dot(problem.forces), 0);
  EXPECT_LT(downhill.dot(product), 0);
}

TEST(MixedSolve, SameBitsForAnyNumberOfThreads) {
  const Problem problem(bracket(24), kNearlyIncompressible);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return solve(*make_mixed_solver(), problem, 1e-6);
  };
  const Eigen::VectorXd one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(5));
}

}  // namespace
}  // namespace sprung
