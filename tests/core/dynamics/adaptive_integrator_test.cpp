#include "core/dynamics/explicit/adaptive_integrator.h"

#include <gtest/gtest.h>

#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

/// A cube that meets frictionless ground at that speed (m/s); sound moves at 10 m/s in it.
World world_of_impact(double speed) {
  World world;
  world.bodies.push_back(touching_box({4, 4, 4}, 0.05, test_material(0.3, 1e5), Vec3(0, 0.001, 0)));
  world.bodies[0].velocities.rowwise() = Vec3(1, -speed, 0).transpose();
  world.obstacles = {level_ground(0, 0)};
  return world;
}

Vec3 center_of_mass(const Body& body) { return body.positions.transpose() * body.masses / body.masses.sum(); }

/// Steps that were stable when the frame began are not once bricks have lost most of their volume.
TEST(AdaptiveIntegrator, ShortensStepsWhereBricksAreFlattened) {
  constexpr double kFrame = 0.02;  // s
  for (const Scheme scheme : {Scheme::kSymplecticEuler, Scheme::kVerlet}) {
    World world = world_of_impact(25);
    const Steps planned = choose_steps(world, kFrame)[0].steps;
    const double start = center_of_mass(world.bodies[0]).x();
    AdaptiveIntegrator motion(world, scheme);
    int repeated = 0;
    const std::vector<GroupSteps> groups = motion.advance_frame(
        0, kFrame, [](double) {}, [&](const std::string&) { ++repeated; });
    EXPECT_EQ(repeated, 0);
    EXPECT_GT(groups[0].steps.count, planned.count);
    EXPECT_LT(groups[0].steps.dt, 0.95 * planned.dt);
    EXPECT_EQ(inverted_bricks(world.bodies[0]), 0);
    // No time is lost: nothing acts on it sideways.
    EXPECT_NEAR(center_of_mass(world.bodies[0]).x() - start, kFrame, 1e-12);
  }
}

TEST(AdaptiveIntegrator, KeepsThePlannedStepsWhereBricksKeepTheirVolume) {
  World world = world_of_impact(1);
  const Steps planned = choose_steps(world, 0.02)[0].steps;
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  const std::vector<GroupSteps> groups = motion.advance_frame(
      0, 0.02, [](double) {}, [](const std::string&) {});
  EXPECT_EQ(groups[0].steps.count, planned.count);
  EXPECT_EQ(groups[0].steps.dt, planned.dt);
}

/// Below a fiftieth of their volume bricks become no stiffer: steps chosen there are not chosen again and again.
TEST(AdaptiveIntegrator, KeepsThePlannedStepsOfBricksThatAreFlatAlready) {
  World world = world_of_impact(0);
  SoftBody& cube = world.bodies[0];
  cube.positions.col(1) *= -0.01;
  cube.positions.col(1).array() += 0.01;
  const Steps planned = choose_steps(world, 1e-3)[0].steps;
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  int repeated = 0;
  const std::vector<GroupSteps> groups = motion.advance_frame(
      0, 1e-3, [](double) {}, [&](const std::string&) { ++repeated; });
  EXPECT_EQ(repeated, 0);
  EXPECT_GT(planned.count, 10);
  EXPECT_EQ(groups[0].steps.count, planned.count);
}

}  // namespace
}  // namespace sprung
