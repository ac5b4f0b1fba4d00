#include "core/dynamics/divergence.h"

#include <gtest/gtest.h>

#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/error.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

constexpr double kBrick = 0.05;  // m

/// One box at rest, of a material in which sound moves at 10 m/s.
World world_of_box(const Eigen::Vector3i& counts = {4, 4, 4}) {
  World world;
  const Material material = test_material(0.3, 1e5);
  world.bodies.push_back(touching_box(counts, kBrick, material, Vec3(0, 0.1, 0)));
  return world;
}

void expect_remedy(const World& world, const std::string& remedy, std::size_t brick = 0) {
  const std::string given = advice_for_divergence(world, 0, brick);
  EXPECT_NE(given.find(remedy), std::string::npos) << given;
}

TEST(Divergence, OfBodiesInEachOtherIsHelpedByMovingThemApart) {
  World world = world_of_box();
  world.bodies.push_back(world.bodies[0]);
  world.bodies[1].positions.col(1).array() += 4 * kBrick - 0.02;
  expect_remedy(world, "bodies 1 and 2 lie 2 cm deep in each other: move them apart");
  world.bodies[1].positions.col(1).array() += 0.03;
  expect_remedy(world, "use more bricks, a stiffer material, more damping or a shorter fall");
}

TEST(Divergence, AtTheSpeedOfSoundIsHelpedByALowerSpeed) {
  World world = world_of_box();
  world.bodies[0].velocities.col(1).setConstant(-12);
  expect_remedy(world, "it moves at 12 m/s, where sound in its material moves at 10 m/s");
}

TEST(Divergence, OfInvertedBricksIsHelpedByAStifferMaterial) {
  World world = world_of_box();
  world.bodies[0].positions.col(1) *= -0.2;
  expect_remedy(world, "64 of its 64 bricks are inverted: use a stiffer or lighter material");
}

TEST(Divergence, OfSpringsTooStiffForTheirMassIsHelpedByASofterRegion) {
  World world = world_of_box();
  SoftBody& body = world.bodies[0];
  body.stiffness_scale.assign(64, 1);
  body.stiffness_scale[63] = 400;
  expect_remedy(world, "times that of most of the body", 63);
  expect_remedy(world, "use more bricks, a stiffer material, more damping or a shorter fall", 21);
}

TEST(Divergence, OfASingleLayerIsHelpedByMoreBricks) {
  expect_remedy(world_of_box({4, 1, 4}), "one brick of 5 cm thick: use more bricks");
}

/// The integrator reports it.
TEST(Divergence, IsTold) {
  World world = world_of_box();
  world.bodies[0].velocities(0, 1) = 1e300;
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  try {
    static_cast<void>(motion.advance_frame(
        0, 1e-3, [](double) {}, [](const std::string&) {}));
    FAIL() << "it came through";
  } catch (const Diverged& error) {
    EXPECT_NE(std::string(error.what()).find("sound in its material moves at 10 m/s"), std::string::npos)
        << error.what();
  }
}

/// Contact would otherwise list everything that may meet: all pairs of features, more than memory holds.
TEST(Divergence, EndsAStepInWhichANodeWouldPassItsWholeBody) {
  constexpr double kStep = 1e-4;  // s
  World world = world_of_box();
  world.bodies[0].contact.with_itself = true;
  world.bodies[0].velocities(0, 1) = kBrick / kStep;
  advance(world, Scheme::kSymplecticEuler, kStep, 1, 0);
  world.bodies[0].velocities(0, 1) = 3 * kBrick / kStep;
  try {
    advance(world, Scheme::kSymplecticEuler, kStep, 1, 0);
    FAIL() << "it came through";
  } catch (const Diverged& error) {
    EXPECT_EQ(error.body(), 0U);
    EXPECT_NE(std::string(error.what()).find("bricks against the rest in a time step"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sprung
