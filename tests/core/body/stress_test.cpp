#include "core/body/stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/bodies.h"

/// Stresses at nodes and points, from displacements whose stresses are known.
namespace sprung {
namespace {

constexpr double kModulus = 2e5;
constexpr double kRatio = 0.3;

Body block(const Eigen::Vector3i& counts) {
  return make_body(make_box_grid(counts, 0.01), Model::kCalibrated, test::test_material(kRatio, kModulus));
}

Points moved(const Body& body, const std::function<Vec3(const Vec3&)>& displacement) {
  Points positions = body.rest_positions;
  for (auto place : positions.rowwise()) place += displacement(place.transpose()).transpose();
  return positions;
}

TEST(Stress, OfAUniformStrainIsHookesEverywhere) {
  const Body body = block({3, 2, 4});
  Mat3 strain;
  strain << 1, 0.4, -0.2, 0.4, -0.5, 0.3, -0.2, 0.3, 0.7;
  strain *= 1e-7;
  const StressTensors stresses = recover_stress(body, moved(body, [&](const Vec3& at) { return Vec3(strain * at); }));
  const double lambda = kModulus * kRatio / ((1 + kRatio) * (1 - 2 * kRatio));
  const double mu = kModulus / (2 * (1 + kRatio));
  const Mat3 hooke = lambda * strain.trace() * Mat3::Identity() + 2 * mu * strain;
  Eigen::Matrix<double, 1, 6> expected;
  expected << hooke(0, 0), hooke(1, 1), hooke(2, 2), hooke(0, 1), hooke(1, 2), hooke(2, 0);
  EXPECT_LT((stresses.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-5 * hooke.norm());
  EXPECT_NEAR(von_mises(stresses)[0], std::sqrt(1.5) * (hooke - hooke.trace() / 3 * Mat3::Identity()).norm(),
              1e-5 * hooke.norm());
}

/// sigma_xx = E kappa y, nothing else, in beams of any thickness, at their faces too; in space turned by any angle.
TEST(Stress, OfPureBendingIsRightAtTheFaces) {
  const double kappa = 1e-5;  // 1/m
  for (const int layers : {1, 2, 5}) {
    const Body body = block({8, layers, 3});
    const Vec3 middle = body.rest_positions.colwise().mean();
    const auto bend = [&](const Vec3& at) {
      const Vec3 p = at - middle;
      return Vec3(kappa * p.x() * p.y(), -kappa / 2 * (p.x() * p.x() + kRatio * (p.y() * p.y() - p.z() * p.z())),
                  -kRatio * kappa * p.y() * p.z());
    };
    const Mat3 turn = rotation_matrix({20, 30, 40});
    const StressTensors stresses = recover_stress(body, moved(body, bend) * turn.transpose());
    const double most = kModulus * kappa * 0.005 * layers;
    for (int node = 0; node < body.node_count(); ++node) {
      const Mat3 along =
          turn.col(0) * turn.col(0).transpose() * kModulus * kappa * (body.rest_positions(node, 1) - middle.y());
      const Eigen::Matrix<double, 1, 6> row = stresses.row(node);
      Mat3 found;
      found << row[0], row[3], row[5], row[3], row[1], row[4], row[5], row[4], row[2];
      EXPECT_LT((found - along).norm(), 1e-3 * most) << layers << " layers";
    }
  }
}

/// Displacements of linear statics are infinitesimal: a small rotation, to first order, causes no strain.
TEST(Stress, OfSmallStrainsIsLinearInTheDisplacements) {
  Body body = block({4, 3, 2});
  place(body, rotation_matrix({10, -20, 30}), {0.1, 0, 0});
  Mat3 slope;
  slope << 0.02, -0.3, 0.1, 0.3, -0.01, 0.2, -0.1, -0.2, 0.03;
  const auto at = [&](double size) {
    const Points positions = body.rest_positions + size * body.rest_positions * slope.transpose();
    return recover_stress(body, positions, StrainMeasure::kSmall);
  };
  const StressTensors small = at(1e-3);
  EXPECT_LT((at(1) / 1e3 - small).cwiseAbs().maxCoeff(), 1e-6 * small.cwiseAbs().maxCoeff());
  const double shear = kModulus / (1 + kRatio);
  EXPECT_NEAR(small(0, 0) - small(0, 1), 1e-3 * shear * 0.03, 1e-6 * shear);
  EXPECT_NEAR(small(0, 3), 0, 1e-9 * kModulus);
}

TEST(Stress, PrincipalOnesComeLargestFirstWithTheirDirections) {
  StressTensors one(1, 6);
  one << 1, 2, 3, 0.5, -0.4, 0.3;
  const PrincipalStresses principal = principal_stresses(one);
  EXPECT_GT(principal.values(0, 0), principal.values(0, 1));
  EXPECT_GT(principal.values(0, 1), principal.values(0, 2));
  EXPECT_NEAR(principal.values.sum(), 6, 1e-12);
  const Mat3& axes = principal.directions[0];
  const Mat3 back = axes * principal.values.row(0).transpose().asDiagonal() * axes.transpose();
  EXPECT_NEAR(back(0, 1), 0.5, 1e-12);
  EXPECT_NEAR(back(1, 2), -0.4, 1e-12);
}

}  // namespace
}  // namespace sprung
