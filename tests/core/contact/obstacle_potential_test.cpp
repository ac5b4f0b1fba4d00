#include "core/contact/obstacle_potential.h"

#include <gtest/gtest.h>

#include <random>
#include <variant>

#include "tests/support/bodies.h"
#include "tests/support/worlds.h"

namespace sprung {
namespace {

/// A cube that every kind of solid penetrates, and that has slid along it since the step began.
struct Touching {
  explicit Touching(const Shape& shape) {
    obstacle.shape = shape;
    obstacle.pose.translation = {0.02, -0.045, 0.03};
    if (std::holds_alternative<SolidHalfSpace>(shape)) obstacle.pose.translation.y() = 0.005;
    obstacle.velocity = {0.1, 0.02, 0};
    obstacle.spin = {0, 0.4, 0.3};
    obstacle.friction = 0.6;
    std::mt19937 random(5);
    test::shake(world.bodies[0], 1e-3, random);
    now = world.bodies[0].positions;
    now.rowwise() += Eigen::RowVector3d(2e-4, -3e-3, 1e-4);
  }
  World world = test::world_of(test::box_body({3, 3, 3}, 0.02, Model::kCalibrated, 0.3));
  Obstacle obstacle;
  Points now;
};

class ObstaclePotentialOf : public testing::TestWithParam<Shape> {};

/// Forces are minus the gradient of the energy, along a displacement of all nodes.
TEST_P(ObstaclePotentialOf, FollowsFromItsEnergy) {
  Touching touching(GetParam());
  SoftBody& body = touching.world.bodies[0];
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  for (const double slip_speed : {1.0, 1e-3}) {  // sticks, slides
    ObstaclePotential potential(body, touching.obstacle, slip_speed);
    potential.begin(body.positions, 0.01, 0.02);
    potential.update_friction(touching.now);
    const Points way = Points::NullaryExpr(touching.now.rows(), 3, [&] { return part(random); }).matrix().normalized();
    const double step = 1e-7;
    Points forces = Points::Zero(way.rows(), 3);
    potential.add_forces(touching.now, forces);
    Points ahead = Points::Zero(way.rows(), 3);
    Points behind = Points::Zero(way.rows(), 3);
    const double up = potential.add_forces(touching.now + step * way, ahead);
    const double down = potential.add_forces(touching.now - step * way, behind);
    const double along = (forces.array() * way.array()).sum();
    EXPECT_GT(forces.norm(), 1);
    EXPECT_NEAR(along, -(up - down) / (2 * step), 1e-4 * forces.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, ObstaclePotentialOf,
                         testing::Values(SolidHalfSpace{}, SolidBox{.half = {0.08, 0.05, 0.08}},
                                         SolidBall{.radius = 0.05}, SolidCapsule{.radius = 0.05, .half_length = 0.02},
                                         SolidCylinder{.radius = 0.06, .half_length = 0.05}));

}  // namespace
}  // namespace sprung
