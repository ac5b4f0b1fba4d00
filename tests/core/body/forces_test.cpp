#include "core/body/forces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>

#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::kCorrectedModels;
using test::rest_brick;
using test::shake;
using test::test_material;

Eigen::Map<const Eigen::Matrix<double, 24, 1>> as_vector(const CornerVectors<double>& x) {
  return Eigen::Map<const Eigen::Matrix<double, 24, 1>>(x.data());
}

double brick_energy(const BrickLaw& law, double h, const CornerVectors<double>& x) {
  CornerVectors<double> force{};
  return brick_forces<double>(law, h, x, nullptr, force);
}

/// A randomly deformed brick.
CornerVectors<double> deformed_brick(double h, double compression, std::mt19937& random) {
  std::uniform_real_distribution<double> distance(-0.15 * h, 0.15 * h);
  CornerVectors<double> x = rest_brick(h);
  for (std::size_t i = 0; i < 24; ++i) x[i] = (i % 3 == 1 ? compression * x[i] : x[i]) + distance(random);
  return x;
}

TEST(BrickForces, AreTheGradientOfTheEnergy) {
  std::mt19937 random(7);
  const double h = 0.1;
  for (const Model model : kCorrectedModels) {
    for (const double compression : {1.4, 1.0, 0.2, -0.3}) {
      const BrickLaw law = brick_law(model, test_material(0.35), h);
      const CornerVectors<double> x = deformed_brick(h, compression, random);
      CornerVectors<double> force{};
      brick_forces<double>(law, h, x, nullptr, force);
      Eigen::Matrix<double, 24, 1> difference;
      for (std::size_t i = 0; i < 24; ++i) {
        const double step = 1e-6 * h;
        CornerVectors<double> high = x;
        CornerVectors<double> low = x;
        high[i] += step;
        low[i] -= step;
        difference[int(i)] = -(brick_energy(law, h, high) - brick_energy(law, h, low)) / (2 * step);
      }
      EXPECT_LT((as_vector(force) - difference).norm(), 1e-7 * difference.norm()) << compression;
    }
  }
}

TEST(BrickForces, HoldABrickTogetherHoweverFarItIsPulledApart) {
  std::mt19937 random(5);
  const double h = 0.1;
  std::normal_distribution<double> distance(0, h);
  for (const Model model : kCorrectedModels) {
    for (const double poisson : {0.0, 0.1, 0.3, 0.49}) {
      const BrickLaw law = brick_law(model, test_material(poisson), h);
      for (int trial = 0; trial < 2000; ++trial) {
        CornerVectors<double> shape;
        for (double& value : shape) value = distance(random);
        const auto energy = [&](double scale) {
          CornerVectors<double> x = shape;
          for (double& value : x) value *= scale;
          return brick_energy(law, h, x);
        };
        EXPECT_GT(energy(1000), energy(100)) << model_name(model) << ", nu " << poisson << ", trial " << trial;
      }
    }
  }
}

TEST(BrickForces, HaveTheHessianAsTheirDerivative) {
  std::mt19937 random(11);
  const double h = 0.1;
  for (const Model model : kCorrectedModels) {
    for (const double compression : {1.4, 1.0, 0.2, -0.3}) {
      const BrickLaw law = brick_law(model, test_material(0.35), h);
      const CornerVectors<double> x = deformed_brick(h, compression, random);
      BrickMatrix difference;
      for (std::size_t i = 0; i < 24; ++i) {
        const double step = 1e-6 * h;
        CornerVectors<double> moved = x;
        CornerVectors<double> high{};
        CornerVectors<double> low{};
        moved[i] = x[i] + step;
        brick_forces<double>(law, h, moved, nullptr, high);
        moved[i] = x[i] - step;
        brick_forces<double>(law, h, moved, nullptr, low);
        difference.col(int(i)) = -(as_vector(high) - as_vector(low)) / (2 * step);
      }
      const BrickMatrix hessian = brick_hessian(law, h, x);
      EXPECT_LT((hessian - difference).norm(), 1e-7 * hessian.norm()) << compression;
      EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-13 * hessian.norm()) << compression;
    }
  }
}

TEST(BrickForces, DampingTakesEnergyAndLeavesRigidMotionAlone) {
  std::mt19937 random(3);
  const double h = 0.1;
  const BrickLaw law = brick_law(Model::kTensile, test_material(0.3), h);
  const CornerVectors<double> x = deformed_brick(h, 1.0, random);
  CornerVectors<double> elastic{};
  brick_forces<double>(law, h, x, nullptr, elastic);
  const auto damping_force = [&](const CornerVectors<double>& rates) {
    CornerVectors<double> total{};
    brick_forces<double>(law, h, x, &rates, total);
    return Eigen::Matrix<double, 24, 1>(as_vector(total) - as_vector(elastic));
  };
  CornerVectors<double> spin{};
  const Vec3 omega(0.3, -0.2, 0.5);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const Vec3 rate = omega.cross(Vec3(x[3 * corner], x[3 * corner + 1], x[3 * corner + 2])) + Vec3(1, 2, 3);
    for (std::size_t k = 0; k < 3; ++k) spin[3 * corner + k] = rate[int(k)];
  }
  EXPECT_LT(damping_force(spin).norm(), 1e-10 * as_vector(elastic).norm());
  CornerVectors<double> shear{};
  for (std::size_t corner = 0; corner < 8; ++corner) shear[3 * corner] = x[3 * corner + 1];
  EXPECT_LT(as_vector(shear).dot(damping_force(shear)), 0);
}

Body shaken_box(Model model) {
  std::mt19937 random(5);
  BrickGrid grid = make_box_grid({5, 3, 4}, 0.02);
  for (std::size_t i = 0; i < grid.fill.size(); i += 3) grid.fill[i] = 0.37;
  Body body = make_body(std::move(grid), model, test_material(0.4));
  shake(body, 0.2, random);
  return body;
}

TEST(SpringForces, SumToNothing) {
  for (const Model model : kCorrectedModels) {
    const Body body = shaken_box(model);
    ForceWorkspace workspace;
    Points forces;
    spring_forces(body, workspace, forces);
    const double scale = forces.rowwise().norm().sum();
    Vec3 torque = Vec3::Zero();
    for (int i = 0; i < body.node_count(); ++i) {
      torque += Vec3(body.positions.row(i)).cross(Vec3(forces.row(i)));
    }
    EXPECT_GT(scale, 0);
    EXPECT_LT(forces.colwise().sum().norm(), 1e-13 * scale);
    EXPECT_LT(torque.norm(), 1e-13 * scale * 0.1);
  }
}

TEST(SpringForces, AreTheSameBitsForAnyNumberOfThreads) {
  Body body = shaken_box(Model::kTensile);
  body.damping.beta = 1e-3;
  for (int i = 0; i < body.node_count(); ++i) body.velocities.row(i).setConstant(std::sin(i));
  Points first;
  for (const std::size_t threads : {1U, 2U, 4U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ForceWorkspace workspace;
    Points forces;
    spring_forces(body, workspace, forces);
    if (first.rows() == 0) first = forces;
    EXPECT_EQ(forces, first) << threads;
  }
}

TEST(Body, MassIsDensityTimesVolume) {
  const Body body = shaken_box(Model::kTensile);
  EXPECT_NEAR(body.masses.sum(), 1000 * body.grid.volume(), 1e-12);
  EXPECT_GT(body.masses.minCoeff(), 0);
}

TEST(Masses, ArePositiveWhereASolidLiesMostlyOutsideItsBrick) {
  BrickGrid grid = make_box_grid({2, 1, 1}, 0.1);
  grid.fill = {1.2, 0.5};
  grid.moments.resize(2);
  grid.moments[0].covariance = 0.02 * Mat3::Identity();
  grid.moments[0].centroid = {-0.95, 0.1, 0.7};  // it has absorbed neighbours
  const Body body = make_body(std::move(grid), Model::kCalibrated, test::test_material(0.3));
  EXPECT_GT(body.masses.minCoeff(), 1e-4 * body.masses.sum());
}

TEST(Body, FillScalesTheWholeLaw) {
  BrickGrid grid = make_box_grid({1, 1, 1}, 0.1);
  Body full = make_body(grid, Model::kTensile, test_material(0.3));
  grid.fill[0] = 0.25;
  Body part = make_body(grid, Model::kTensile, test_material(0.3));
  full.positions *= 1.1;
  part.positions *= 1.1;
  EXPECT_NEAR(elastic_energy(part), 0.25 * elastic_energy(full), 1e-12 * elastic_energy(full));
}

TEST(Body, TurnedHexahedraAnswerLikeUnturnedOnes) {
  std::mt19937 random(4);
  Body still = make_body(make_box_grid({2, 1, 1}, 0.1), Model::kFem, test_material(0.3));
  Body flipped = still;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  place(flipped, turn, Vec3(1, 0, 0));
  shake(still, 0.01, random);
  flipped.positions += (still.positions - still.rest_positions) * turn.transpose();
  EXPECT_NEAR(elastic_energy(flipped) / elastic_energy(still), 1, 1e-9);
}

TEST(Body, CountsInvertedBricks) {
  Body body = make_body(make_box_grid({2, 1, 1}, 0.1), Model::kTensile, test_material(0.3));
  EXPECT_EQ(inverted_bricks(body), 0);
  EXPECT_NEAR(smallest_volume_ratio(body), 1, 1e-12);
  for (int i = 0; i < body.node_count(); ++i) {
    if (body.positions(i, 0) > 0.15) body.positions(i, 0) = 0.05;
  }
  EXPECT_EQ(inverted_bricks(body), 1);
  EXPECT_NEAR(smallest_volume_ratio(body), -0.5, 1e-12);
}

}  // namespace
}  // namespace sprung
