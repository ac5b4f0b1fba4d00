#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/body/brick_hessian.h"
#include "core/body/brick_model.h"
#include "core/body/brick_tiles.h"
#include "core/body/forces.h"
#include "core/body/solid_tiles.h"
#include "core/law/anchored_matrix.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::material_of_law;
using test::shake;

/// Whole bricks, in long and short rows, bricks of which only the fill is known, and cut ones, with holes between them;
/// two materials; strongly deformed, some inverted, and in motion.
Body ragged_solid(double poisson, const StrainEnergyLaw& law = {}) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> between(-1, 1);
  BrickGrid grid;
  grid.brick_size = 0.02;
  for (const Eigen::Vector3i& cell : make_box_grid({45, 17, 13}, 1).cells) {
    if (between(random) > 0.9) continue;
    const bool is_cut = cell.y() > 7 && between(random) > 0;
    SolidMoments moments;
    if (is_cut) {
      Mat3 spread;
      for (double& entry : spread.reshaped()) entry = 0.2 * between(random);
      moments.covariance = spread * spread.transpose() + 0.01 * Mat3::Identity();
      for (double& place : moments.centroid) place = 0.2 * between(random);
    }
    grid.cells.push_back(cell);
    grid.moments.push_back(moments);
    grid.fill.push_back(is_cut || cell.z() == 3 ? 0.6 + 0.3 * between(random) : 1.0);
  }
  number_nodes(grid);
  Body body = make_body(std::move(grid), Model::kCalibrated, material_of_law(law, poisson));
  for (std::size_t brick = 0; brick < body.stiffness_scale.size(); brick += 2) body.stiffness_scale[brick] *= 7;
  build_tiles(body);
  shake(body, 0.3, random);
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == 5) body.positions(node, 0) += 1.3 * body.grid.brick_size;
  }
  for (double& velocity : body.velocities.reshaped()) velocity = between(random);
  return body;
}

/// Brick by brick.
template <class Pull>
Points sum_over_bricks(const Body& body, const Pull& pull) {
  Points sums = Points::Zero(body.node_count(), 3);
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    const BrickVector at_brick =
        pull(brick, at_corners(body, brick, body.positions), at_corners(body, brick, body.velocities));
    for (int corner = 0; corner < 8; ++corner) {
      sums.row(body.grid.nodes[brick][corner]) += at_brick.segment<3>(3 * corner).transpose();
    }
  }
  return sums;
}

double largest(const Points& values) { return values.cwiseAbs().maxCoeff(); }

constexpr std::array<double, 3> kRatios{-0.2, 0.3, 0.49};

TEST(SolidRows, PullLikeTheirBricks) {
  const BrickModel& model = brick_model(Model::kCalibrated);
  for (const double poisson : kRatios) {
    Body body = ragged_solid(poisson);
    EXPECT_LT(inverted_bricks(body), body.grid.brick_count() / 4);
    EXPECT_GT(inverted_bricks(body), 0);
    for (const double beta : {0.0, 1e-3}) {
      body.damping.beta = beta;
      const Points expected = sum_over_bricks(body, [&](std::size_t brick, const BrickVector& x, const BrickVector& v) {
        return model.damped_forces(body, brick, x, v);
      });
      for (const SpringKernel& kernel : all_spring_kernels()) {
        if (kernel.tile == nullptr) continue;
        Points forces;
        SpringSystem(kernel).forces(body, forces);
        EXPECT_LT(largest(forces - expected), 1e-13 * largest(expected)) << poisson << ' ' << beta << kernel.name;
      }
    }
  }
}

TEST(SolidRows, AreLongRowsOfWholeBricksAndTheOthersAreGathered) {
  const Body body = ragged_solid(0.3);
  const BrickTiles& tiles = *body.tiles;
  std::vector<bool> is_cut;
  for (const int pack : tiles.gathered.packs) is_cut.push_back(tiles.gathered.numbers[pack] < 0);
  EXPECT_FALSE(tiles.tiles.empty());
  EXPECT_NE(std::find(is_cut.begin(), is_cut.end(), false), is_cut.end());
  EXPECT_NE(std::find(is_cut.begin(), is_cut.end(), true), is_cut.end());
  EXPECT_TRUE(std::is_sorted(is_cut.begin(), is_cut.end()));
  for (const BrickTile& tile : tiles.tiles) {
    for (const double share : tile.shares) EXPECT_GE(share, 0);
  }
}

TEST(SolidRows, AreDampedLikeTheirBricks) {
  const BrickModel& model = brick_model(Model::kCalibrated);
  Body body = ragged_solid(0.4);
  constexpr double kFactor = 2;
  const Points expected = sum_over_bricks(body, [&](std::size_t brick, const BrickVector& x, const BrickVector& v) {
    return BrickVector(kFactor * model.damping_product(body, brick, x, v));
  });
  const Eigen::VectorXd rates = body.velocities.reshaped<Eigen::RowMajor>();
  body.velocities.setZero();
  for (const SpringKernel& kernel : all_spring_kernels()) {
    if (kernel.tile == nullptr) continue;
    Eigen::VectorXd product;
    SpringSystem(kernel).multiply_along(body, body.positions, kFactor, rates, product);
    EXPECT_LT((product - expected.reshaped<Eigen::RowMajor>()).cwiseAbs().maxCoeff(), 1e-13 * largest(expected))
        << kernel.name;
  }
}

TEST(SolidRows, MultiplyLikeTheirBricks) {
  const BrickModel& model = brick_model(Model::kCalibrated);
  for (const double poisson : kRatios) {
    const Body body = ragged_solid(poisson);
    const Points expected = sum_over_bricks(body, [&](std::size_t brick, const BrickVector& x, const BrickVector& v) {
      return model.product(body, brick, x, v);
    });
    const Eigen::VectorXd moves = body.velocities.reshaped<Eigen::RowMajor>();
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr) continue;
      Eigen::VectorXd product;
      SpringSystem(kernel).multiply(body, moves, product);
      EXPECT_LT((product - expected.reshaped<Eigen::RowMajor>()).cwiseAbs().maxCoeff(), 1e-13 * largest(expected))
          << poisson << ' ' << kernel.name;
    }
  }
}

TEST(SolidRows, HaveTheHessiansOfTheirBricks) {
  for (const double poisson : kRatios) {
    const Body body = ragged_solid(poisson);
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr) continue;
      for (int first = 0; first < body.grid.brick_count(); first += kPackPadding) {
        std::array<double, kAnchoredSize * kPackPadding> matrices{};
        solid_matrices(body, first, matrices.data(), kernel);
        for (int lane = 0; lane < kPackPadding; ++lane) {
          BrickMatrix expected = BrickMatrix::Zero();
          if (first + lane < body.grid.brick_count()) expected = body_brick_hessian(body, first + lane);
          double error = 0;
          for (std::size_t a = 0; a < 21; ++a) {
            for (std::size_t b = 0; b <= a; ++b) {
              const double entry = matrices[anchored_index(a, b) * kPackPadding + lane];
              error = std::max(error, std::abs(entry - expected(a + 3, b + 3)));
            }
          }
          EXPECT_LE(error, 1e-13 * expected.cwiseAbs().maxCoeff()) << poisson << ' ' << kernel.name << first + lane;
        }
      }
    }
  }
}

TEST(SolidRows, HaveTheEnergyOfTheirBricks) {
  const BrickModel& model = brick_model(Model::kCalibrated);
  for (const double poisson : kRatios) {
    const Body body = ragged_solid(poisson);
    double expected = 0;
    for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
      expected += model.energy(body, brick, at_corners(body, brick, body.positions));
    }
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr) continue;
      EXPECT_NEAR(SpringSystem(kernel).energy(body) / expected, 1, 1e-13) << poisson << ' ' << kernel.name;
    }
  }
}

/// The plain kernel of x86-64 has no fused multiply-add and rounds more often.
TEST(SolidRows, MoveToTheSameBitsOnAnyNumberOfThreadsAndInstructionSet) {
  Body start = ragged_solid(0.4);
  start.damping = {.alpha = 0.3, .beta = 1e-6};
  const Eigen::VectorXd inverse_masses = start.masses.cwiseInverse();
  const auto moved = [&](const SpringKernel& kernel, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    SpringSystem bricks(kernel);
    Body body = start;
    for (int step = 0; step < 5; ++step) {
      bricks.move(body, {.drift = 1e-6, .kick = 1e-6, .damping = body.damping, .gravity = {0, -9.81, 0}},
                  inverse_masses);
    }
    return body;
  };
  const Body best = moved(best_spring_kernel(), 1);
  EXPECT_GT(largest(best.velocities - start.velocities), 1e-3);
  for (const SpringKernel& kernel : all_spring_kernels()) {
    if (kernel.tile == nullptr) continue;
    const bool is_plain = kernel.name == std::string("plain");
    for (const std::size_t threads : {1U, 2U, 4U}) {
      const Body body = moved(kernel, threads);
      EXPECT_LE(largest(body.positions - best.positions), is_plain ? 1e-15 : 0.0) << kernel.name << threads;
      EXPECT_LE(largest(body.velocities - best.velocities), is_plain ? 1e-9 : 0.0) << kernel.name << threads;
    }
  }
}

/// Scalar and packed laws share no arithmetic: the one goes by the singular values of F, the other by invariants and
/// the eigenvectors of F^T F.
TEST(SolidRows, AnswerLikeTheirBricksByEveryLaw) {
  const BrickModel& model = brick_model(Model::kCalibrated);
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    const Body body = ragged_solid(0.45, law);
    const Points forces = sum_over_bricks(body, [&](std::size_t brick, const BrickVector& x, const BrickVector&) {
      return model.forces(body, brick, x);
    });
    const Points products = sum_over_bricks(body, [&](std::size_t brick, const BrickVector& x, const BrickVector& v) {
      return model.product(body, brick, x, v);
    });
    double energy = 0;
    for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
      energy += model.energy(body, brick, at_corners(body, brick, body.positions));
    }
    const Eigen::VectorXd moves = body.velocities.reshaped<Eigen::RowMajor>();
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr) continue;
      SCOPED_TRACE(law_text(law) + ' ' + kernel.name);
      SpringSystem bricks(kernel);
      Points pulled;
      bricks.forces(body, pulled);
      EXPECT_LT(largest(pulled - forces), 1e-12 * largest(forces));
      Eigen::VectorXd product;
      bricks.multiply(body, moves, product);
      EXPECT_LT((product - products.reshaped<Eigen::RowMajor>()).cwiseAbs().maxCoeff(), 1e-10 * largest(products));
      EXPECT_NEAR(bricks.energy(body) / energy, 1, 1e-12);
    }
  }
}

/// The plain kernel of x86-64 rounds more often, see below.
TEST(SolidRows, PullWithTheSameBitsOnEveryInstructionSetByEveryLaw) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    Body body = ragged_solid(0.45, law);
    body.damping.beta = 1e-3;
    Points best;
    SpringSystem(best_spring_kernel()).forces(body, best);
    for (const SpringKernel& kernel : all_spring_kernels()) {
      if (kernel.tile == nullptr || kernel.name == std::string("plain")) continue;
      Points forces;
      SpringSystem(kernel).forces(body, forces);
      EXPECT_EQ(largest(forces - best), 0) << law_text(law) << ' ' << kernel.name;
    }
  }
}

}  // namespace
}  // namespace sprung
