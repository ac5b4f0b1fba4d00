#include "core/dynamics/statics/rotated_step.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/dynamics/statics/statics.h"
#include "tests/support/calibrated_box.h"

namespace sprung {
namespace {

/// 20 x 1 x 1 bricks of 10 mm along x, held at x = 0.
struct Strip {
  Body body = test::calibrated_box({20, 1, 1}, 0.01, 0.3, 1e5);
  Supports supports{body.node_count()};

  explicit Strip(bool is_held = true) {
    for (int node = 0; node < body.node_count(); ++node) {
      if (is_held && body.positions(node, 0) < 1e-9) supports.fix(node);
    }
  }
  [[nodiscard]] double length_of_middle_line(const Points& positions) const {
    double length = 0;
    Vec3 before = Vec3::Zero();
    for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
      const Vec3 middle = columns_of(body.grid.nodes[brick], positions).rowwise().mean();
      if (brick > 0) length += (middle - before).norm();
      before = middle;
    }
    return length;
  }
};

/// The displacements by a rotation vector that grows along x to `angle`, to first order.
Eigen::VectorXd bending(const Points& positions, double angle, double length) {
  Eigen::VectorXd u(positions.size());
  for (Eigen::Index node = 0; node < positions.rows(); ++node) {
    const Vec3 x = positions.row(node);
    const double turn = angle * x.x() / length;
    u.segment<3>(3 * node) = Vec3(-turn * x.y(), turn * x.x() / 2, 0);
  }
  return u;
}

void expect_turned_as_a_whole(const Body& body, double length) {
  const Supports none(body.node_count());
  RotatedStep step(body, none);
  const Vec3 turn(0.3, -0.9, 0.6);
  const Points& x = body.positions;
  Eigen::VectorXd u(x.size());
  for (Eigen::Index node = 0; node < x.rows(); ++node) u.segment<3>(3 * node) = turn.cross(Vec3(x.row(node)));
  EXPECT_NEAR(step.largest_rotation(x, u), turn.norm(), 1e-9);
  const Points after = step.displaced(x, u);
  const Mat3 rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  const Points expected = (x.rowwise() - x.colwise().mean()) * rotation.transpose();
  EXPECT_LT(((after.rowwise() - after.colwise().mean()) - expected).cwiseAbs().maxCoeff(), 1e-3 * length);
}

TEST(RotatedStep, TurnsAFreeBodyAsAWhole) { expect_turned_as_a_whole(Strip(false).body, 0.2); }

/// By conjugate gradients: to factorize the matrix would take 4e9 operations.
TEST(RotatedStep, TurnsACompactBodyOfManyBricksAsAWhole) {
  expect_turned_as_a_whole(test::calibrated_box({28, 28, 28}, 0.01, 0.3, 1e5), 0.28);
}

TEST(RotatedStep, BendsAStripWithoutStretchingIt) {
  const Strip strip;
  RotatedStep step(strip.body, strip.supports);
  const Points& x = strip.body.positions;
  const Eigen::VectorXd u = bending(x, 1.5, 0.2);
  const double before = strip.length_of_middle_line(x);
  const Points straight = x + Eigen::Map<const Points>(u.data(), x.rows(), 3);
  const Points around = step.displaced(x, u);
  EXPECT_GT(strip.length_of_middle_line(straight), 1.2 * before);
  EXPECT_NEAR(strip.length_of_middle_line(around), before, 0.05 * before);
  for (int node = 0; node < strip.body.node_count(); ++node) {
    if (!strip.supports.fixed[3 * std::size_t(node)]) continue;
    EXPECT_EQ(around.row(node), straight.row(node));
  }
}

TEST(RotatedStep, IsTheStraightOneToFirstOrder) {
  const Strip strip;
  RotatedStep step(strip.body, strip.supports);
  const Points& x = strip.body.positions;
  const auto difference = [&](double angle) {
    const Eigen::VectorXd u = bending(x, angle, 0.2);
    const Points straight = x + Eigen::Map<const Points>(u.data(), x.rows(), 3);
    return (step.displaced(x, u) - straight).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(difference(0.02) / difference(0.01), 4, 0.1);
}

/// With straight steps this takes 24 iterations.
TEST(RotatedStep, LetsNewtonsMethodBendASlenderStripInFewSteps) {
  Strip strip;
  Points loads = Points::Zero(strip.body.node_count(), 3);
  const double inertia = std::pow(0.01, 4) / 12;
  const double force = 8 * 1e5 * inertia / (0.2 * 0.2);  // P L^2 / (E I) = 8: the tip turns by 80 degrees
  for (int node = 0; node < strip.body.node_count(); ++node) {
    if (strip.body.positions(node, 0) > 0.2 - 1e-9) loads(node, 1) = force / 4;
  }
  const std::unique_ptr<LinearSolver> system = make_default_solver();
  const StaticReport report = solve_static(strip.body, strip.supports, loads, strip.body.positions, *system);
  EXPECT_EQ(report.load_steps, 1);
  EXPECT_LE(report.iterations, 8);
}

}  // namespace
}  // namespace sprung
