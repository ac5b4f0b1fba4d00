#include "core/body/brick_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

constexpr double kYoung = 2e4;
constexpr double kPoisson = 0.3;

Body box() {
  return make_body(make_box_grid({3, 2, 2}, 0.1), Model::kCalibrated, test::test_material(kPoisson, kYoung));
}

/// The measure of every brick under an affine map of the nodes; expects all to be equal.
double measured(BrickMeasure measure, const Mat3& map) {
  const Body body = box();
  const Eigen::VectorXd values = measure_bricks(body, measure, body.rest_positions * map.transpose());
  EXPECT_LT(values.maxCoeff() - values.minCoeff(), 1e-9 * std::max(1.0, values.cwiseAbs().maxCoeff()));
  return values[0];
}

Mat3 turn() { return Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix(); }

TEST(BrickMeasures, AreNothingAtRestHoweverTurned) {
  EXPECT_NEAR(measured(BrickMeasure::kStretch, turn()), 1, 1e-12);
  EXPECT_NEAR(measured(BrickMeasure::kStrain, turn()), 0, 1e-12);
  EXPECT_NEAR(measured(BrickMeasure::kStress, turn()), 0, 1e-8);
  EXPECT_NEAR(measured(BrickMeasure::kVolume, turn()), 1, 1e-12);
}

// Stretched along x by 1.2, then turned: E = diag(0.22, 0, 0).
TEST(BrickMeasures, FollowTheClosedFormsOfAStretch) {
  const Mat3 map = turn() * Vec3(1.2, 1, 1).asDiagonal();
  const double strain = 0.5 * (1.2 * 1.2 - 1);
  EXPECT_NEAR(measured(BrickMeasure::kStretch, map), 1.2, 1e-12);
  EXPECT_NEAR(measured(BrickMeasure::kVolume, map), 1.2, 1e-12);
  EXPECT_NEAR(measured(BrickMeasure::kStrain, map), 2.0 / 3 * strain, 1e-12);
  const double stress = kYoung / (2 * (1 + kPoisson)) * (1.2 * 1.2 - 1) / 1.2;  // neo-Hookean: G (s^2 - 1) / J
  EXPECT_NEAR(measured(BrickMeasure::kStress, map), stress, 1e-8 * stress);
}

// To first order the stress of a stretched bar is E times its strain.
TEST(BrickMeasures, GiveHookesLawForSmallPulls) {
  const double strain = 1e-6;
  const Vec3 stretches(1 + strain, 1 - kPoisson * strain, 1 - kPoisson * strain);
  EXPECT_NEAR(measured(BrickMeasure::kStress, stretches.asDiagonal()), kYoung * strain, 1e-5 * kYoung * strain);
}

TEST(BrickMeasures, StressCountsTheStiffnessOfARegion) {
  Body body = box();
  body.stiffness_scale[1] = 3;
  const Points pulled = body.rest_positions * Vec3(1.01, 1, 1).asDiagonal();
  const Eigen::VectorXd stress = measure_bricks(body, BrickMeasure::kStress, pulled);
  EXPECT_NEAR(stress[1] / stress[0], 3, 1e-9);
  EXPECT_NEAR(brick_youngs(body)[1], 3 * kYoung, 1e-6);
}

TEST(NodeMeans, WeighBricksByTheirFill) {
  BrickGrid grid = make_box_grid({2, 1, 1}, 1);
  grid.fill = {1, 0.5};
  const Eigen::VectorXd means = node_means(grid, Eigen::Vector2d(3, 6));
  EXPECT_NEAR(means.minCoeff(), 3, 1e-12);
  EXPECT_NEAR(means.maxCoeff(), 6, 1e-12);
  for (const int node : grid.nodes[0]) {
    const bool is_shared = grid.lattice[node].x() == 1;
    EXPECT_NEAR(means[node], is_shared ? 4 : 3, 1e-12);
  }
}

}  // namespace
}  // namespace sprung
