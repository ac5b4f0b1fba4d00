#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/body/brick_tiles.h"
#include "core/body/forces.h"
#include "tests/bench/spring_list.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::shake;
using test::SpringList;
using test::test_material;

/// Holes, gaps in rows, thin sheets and single bricks, cut into several tiles along every axis.
BrickGrid ragged_grid(std::mt19937& random) {
  BrickGrid grid = make_box_grid({110, 19, 35}, 0.02);
  std::uniform_real_distribution<double> chance(0, 1);
  BrickGrid ragged;
  ragged.brick_size = grid.brick_size;
  for (const Eigen::Vector3i& cell : grid.cells) {
    const double solid = cell.z() < 10 ? 0.97 : (cell.y() == 7 ? 1 : 0.1);
    if (chance(random) < solid) ragged.cells.push_back(cell - Eigen::Vector3i(3, 40, 1));
  }
  for (std::size_t i = 0; i < ragged.cells.size(); ++i) ragged.fill.push_back(i % 3 == 0 ? 0.37 : 1.0);
  number_nodes(ragged);
  return ragged;
}

/// Strongly deformed, and in motion.
Body shaken_body(Model model, double poisson = 0.4) {
  std::mt19937 random(5);
  Body body = make_body(ragged_grid(random), model, test_material(poisson));
  shake(body, 0.25, random);
  for (int i = 0; i < body.node_count(); i += 50) body.positions.row(i) += Eigen::RowVector3d(0.01, 0.015, -0.012);
  std::uniform_real_distribution<double> speed(-1, 1);
  for (double& velocity : body.velocities.reshaped()) velocity = speed(random);
  return body;
}

constexpr std::array<Model, 4> kSpringModels{Model::kTensile, Model::kM1, Model::kM2Plain, Model::kM1Plain};

TEST(SpringSystem, PullsLikeTheListOfSprings) {
  for (const Model model : kSpringModels) {
    Body body = shaken_body(model);
    EXPECT_GT(body.tiles->tiles.size(), 10U);
    for (const double beta : {0.0, 1e-3}) {
      body.damping.beta = beta;
      Points expected;
      SpringList(body).forces(body, expected);
      Points forces;
      SpringSystem().forces(body, forces);
      EXPECT_LT((forces - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff())
          << model_name(model) << ' ' << beta;
    }
  }
}

TEST(SpringSystem, MultipliesAlongItsSpringsAsTheyAreDamped) {
  for (const Model model : kSpringModels) {
    Body body = shaken_body(model);
    body.damping.beta = 0;
    Points undamped;
    SpringSystem().forces(body, undamped);
    constexpr double kFactor = 2;  // so large that little of it is lost in the elastic part
    body.damping.beta = kFactor;
    Points damped;
    SpringSystem().forces(body, damped);
    const Points expected = undamped - damped;
    const Eigen::VectorXd rates = body.velocities.reshaped<Eigen::RowMajor>();
    body.velocities.setZero();
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr) continue;
      Eigen::VectorXd product;
      SpringSystem(kernel).multiply_along(body, body.positions, kFactor, rates, product);
      EXPECT_LT((product - expected.reshaped<Eigen::RowMajor>()).cwiseAbs().maxCoeff(),
                1e-12 * expected.cwiseAbs().maxCoeff())
          << model_name(model) << ' ' << kernel.name;
    }
  }
}

/// A fork: two prongs in the same cells, joined to one handle and not to each other.
BrickGrid fork_grid() {
  constexpr int kHandle = 2;  // bricks along x
  BrickGrid fork = make_box_grid({12, 3, 4}, 0.02);
  const BrickGrid box = fork;
  fork.cells.clear();
  fork.nodes.clear();
  fork.lattice.clear();
  std::vector<std::array<int, 2>> node_of(box.lattice.size());
  for (std::size_t node = 0; node < box.lattice.size(); ++node) {
    for (int prong = 0; prong < (box.lattice[node].x() > kHandle ? 2 : 1); ++prong) {
      node_of[node][prong] = fork.node_count();
      if (prong == 0) node_of[node][1] = fork.node_count();
      fork.lattice.push_back(box.lattice[node]);
    }
  }
  for (std::size_t brick = 0; brick < box.cells.size(); ++brick) {
    for (std::size_t prong = 0; prong < (box.cells[brick].x() >= kHandle ? 2U : 1U); ++prong) {
      fork.cells.push_back(box.cells[brick]);
      std::array<int, 8>& nodes = fork.nodes.emplace_back(box.nodes[brick]);
      for (int& node : nodes) node = node_of[node][prong];
    }
  }
  fork.fill.clear();
  for (int i = 0; i < fork.brick_count(); ++i) fork.fill.push_back(i % 3 == 0 ? 0.37 : 1.0);
  return fork;
}

TEST(SpringSystem, ProngsInTheSameCellsPullLikeTheListOfSprings) {
  Body body = make_body(fork_grid(), Model::kTensile, test_material(0.3));
  std::mt19937 random(7);
  shake(body, 0.25, random);
  Points expected;
  SpringList(body).forces(body, expected);
  Points forces;
  SpringSystem().forces(body, forces);
  EXPECT_LT((forces - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
}

/// If Poisson's ratio is low, part of the axial correction pulls along the mean axes.
TEST(SpringSystem, PullsAlongTheMeanAxesLikeTheListOfSprings) {
  Body body = shaken_body(Model::kTensile, -0.2);
  EXPECT_LT(body.law.axes, 0);
  body.damping.beta = 1e-3;
  Points expected;
  SpringList(body).forces(body, expected);
  Points forces;
  for (const SpringKernel& kernel : all_spring_kernels()) {
    if (kernel.tile == nullptr) continue;
    SpringSystem(kernel).forces(body, forces);
    EXPECT_LT((forces - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff()) << kernel.name;
  }
}

TEST(SpringSystem, HasTheEnergyOfItsBricks) {
  for (const Model model : kSpringModels) {
    const Body body = shaken_body(model, model == Model::kTensile ? -0.2 : 0.4);
    double expected = 0;
    for (std::size_t brick = 0; brick < body.grid.cells.size(); ++brick) {
      CornerVectors<double> force{};
      expected += body.stiffness_scale[brick] *
                  brick_forces<double>(body.law, body.grid.brick_size, brick_corners(body, brick), nullptr, force);
    }
    EXPECT_NEAR(SpringSystem().energy(body) / expected, 1, 1e-12) << model_name(model);
  }
}

/// A few steps of motion with everything in it.
void move(Body& body, const SpringKernel& kernel) {
  SpringSystem springs(kernel);
  body.damping = {.alpha = 0.3, .beta = 1e-4};
  const Eigen::VectorXd inverse_masses = body.masses.cwiseInverse();
  for (int step = 0; step < 5; ++step) {
    springs.move(body,
                 {.drift = step == 0 ? 0 : 1e-5, .kick = 1e-5, .damping = body.damping, .gravity = {0.1, -9.81, 0.2}},
                 inverse_masses);
  }
}

TEST(SpringSystem, MovesToTheSameBitsOnAnyNumberOfThreads) {
  Body first = shaken_body(Model::kTensile);
  Body start = first;
  move(first, best_spring_kernel());
  for (const std::size_t threads : {1U, 2U, 4U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Body body = start;
    move(body, best_spring_kernel());
    EXPECT_EQ(body.positions, first.positions) << threads;
    EXPECT_EQ(body.velocities, first.velocities) << threads;
  }
}

/// But for the plain one of x86-64, which has no fused multiply-add and rounds more often.
TEST(SpringSystem, MovesToTheSameBitsOnAnyInstructionSet) {
  for (const Model model : kSpringModels) {
    const Body start = shaken_body(model);
    Body best = start;
    move(best, best_spring_kernel());
    EXPECT_NE(best.positions, start.positions);
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr) continue;
      Body body = start;
      move(body, kernel);
      const double most = kernel.name == std::string("plain") ? 1e-13 : 0;
      EXPECT_LE((body.positions - best.positions).cwiseAbs().maxCoeff(), most) << kernel.name;
      EXPECT_LE((body.velocities - best.velocities).cwiseAbs().maxCoeff(), 1e5 * most) << kernel.name;
    }
  }
}

TEST(SpringSystem, MoveIsDriftThenKick) {
  Body moved = shaken_body(Model::kTensile);
  moved.damping = {.alpha = 2, .beta = 1e-4};
  Body expected = moved;
  const double drift = 1e-4;
  const double kick = 2e-4;
  const Vec3 gravity(1, -9.81, 3);
  const Eigen::VectorXd inverse_masses = moved.masses.cwiseInverse();
  expected.positions += drift * expected.velocities;
  ForceWorkspace workspace;
  Points forces;
  spring_forces(expected, workspace, forces);
  expected.velocities *= 1 - kick * expected.damping.alpha;
  expected.velocities += kick * (inverse_masses.asDiagonal() * forces);
  expected.velocities.rowwise() += kick * gravity.transpose();
  SpringSystem().move(moved, {.drift = drift, .kick = kick, .damping = moved.damping, .gravity = gravity},
                      inverse_masses);
  EXPECT_LT((moved.positions - expected.positions).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((moved.velocities - expected.velocities).cwiseAbs().maxCoeff(),
            1e-14 * expected.velocities.cwiseAbs().maxCoeff());
}

/// A stretch of 1e-9 keeps seven digits if the body is near the origin: the resolution of the positions themselves.
TEST(SpringSystem, SmallStrainsSurviveRounding) {
  Body body = make_body(make_box_grid({4, 3, 2}, 1), Model::kTensile, test_material(0.3));
  const double strain = 1e-9;
  const double h = body.grid.brick_size;
  body.positions.col(0) *= 1 + strain;
  const double lame = body.material.lame_lambda() + 2 * body.material.shear_modulus();
  Points forces;
  SpringSystem().forces(body, forces);
  double pull = 0;
  for (int i = 0; i < body.node_count(); ++i) pull += body.rest_positions(i, 0) > 3.5 * h ? -forces(i, 0) : 0;
  EXPECT_NEAR(pull / (lame * strain * 6), 1, 1e-6);
}

TEST(SpringSystem, IsWellAgainAfterNumbersThatAreNotFinite) {
  Body body = shaken_body(Model::kTensile);
  SpringSystem springs;
  Points expected;
  springs.forces(body, expected);
  const Points good = body.positions;
  body.positions.row(77).setConstant(std::nan(""));
  Points forces;
  springs.forces(body, forces);
  EXPECT_FALSE(forces.allFinite());
  EXPECT_FALSE(std::isfinite(springs.energy(body)));
  body.positions = good;
  springs.forces(body, forces);
  EXPECT_EQ(forces, expected);
}

TEST(SpringSystem, BricksFlattenedToNothingPullWithFiniteForces) {
  Body body = make_body(make_box_grid({3, 2, 2}, 0.1), Model::kTensile, test_material(0.3));
  body.positions.setZero();
  Points forces;
  SpringSystem().forces(body, forces);
  EXPECT_TRUE(forces.allFinite());
}

/// Near rest, where what is left of large forces shows the order in which they were added up.
TEST(BrickTiles, NarrowBodiesHaveTheSameBitsOnEveryInstructionSet) {
  for (const Model model : {Model::kTensile, Model::kCalibrated}) {
    for (int wide = 1; wide <= 8; ++wide) {
      Body body = make_body(make_box_grid({wide, 4, 3}, 0.02), model, test_material(0.3));
      std::mt19937 random(3);
      shake(body, 1e-6, random);
      for (const BrickTile& tile : body.tiles->tiles) EXPECT_GT(tile.pitch, kPackPadding);
      std::optional<Points> first;
      for (const SpringKernel& kernel : all_spring_kernels()) {
        if (kernel.tile == nullptr || kernel.name == std::string("plain")) continue;  // it does not fuse operations
        Points forces;
        SpringSystem(kernel).forces(body, forces);
        EXPECT_TRUE(!first || forces == *first) << wide << kernel.name;
        first = forces;
      }
    }
  }
}

TEST(BrickTiles, FollowAChangeOfStiffness) {
  Body body = make_body(make_box_grid({3, 2, 2}, 0.1), Model::kTensile, test_material(0.3));
  body.positions *= 1.1;
  const double energy = elastic_energy(body);
  for (double& scale : body.stiffness_scale) scale *= 3;
  build_tiles(body);
  EXPECT_NEAR(elastic_energy(body) / energy, 3, 1e-12);
}

}  // namespace
}  // namespace sprung
