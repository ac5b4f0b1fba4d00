#include "core/contact/glue.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/body/forces.h"
#include "core/contact/search/contact_surface.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

/// Two cubes of different bricks, side by side.
World two_cubes() {
  World world;
  world.gravity.setZero();
  world.bodies.push_back(touching_box({4, 4, 4}, 0.01, test_material(0.3, 2e4), Vec3::Zero()));
  world.bodies.push_back(touching_box({3, 3, 3}, 0.04 / 3, test_material(0.3, 8e4), {0.0401, 0, 0}));
  return world;
}

double furthest_apart(const World& world) {
  double furthest = 0;
  for (const GluedPoint& point : world.glue) {
    Vec3 apart = Vec3::Zero();
    for (std::size_t side = 0; side < 2; ++side) {
      const Body& body = world.bodies[point.bodies[side]];
      apart += (side == 0 ? 1 : -1) * carried(body, point.bricks[side], point.weights[side], body.positions);
    }
    furthest = std::max(furthest, apart.norm());
  }
  return furthest;
}

TEST(Glue, HoldsWhereSkinsLieTogether) {
  World world = two_cubes();
  EXPECT_TRUE(glue_between(world, 0, 1, 0.00005).empty());
  world.glue = glue_between(world, 0, 1, 0.001);
  EXPECT_EQ(world.glue.size(), 25U);  // the nodes of the finer face
  EXPECT_LT(furthest_apart(world), 1e-12);
  const std::vector<GluedPoint> flipped = glue_between(world, 1, 0, 0.001);
  EXPECT_EQ(flipped.size(), world.glue.size());
}

/// One is pulled away: the other follows, they stay together, and their mutual forces cancel.
TEST(Glue, KeepsTogetherWhatIsDrawnApart) {
  World world = two_cubes();
  world.glue = glue_between(world, 0, 1, 0.001);
  for (SoftBody& body : world.bodies) body.damping = {.alpha = 0, .beta = 1e-4};
  world.bodies[1].velocities.col(0).setConstant(0.5);
  const auto momentum = [&] { return Vec3(linear_momentum(world.bodies[0]) + linear_momentum(world.bodies[1])); };
  const Vec3 before = momentum();
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  for (int frame = 0; frame < 20; ++frame) {
    static_cast<void>(motion.advance_frame(
        frame * 0.01, 0.01, [](double) {}, [](const std::string& message) { ADD_FAILURE() << message; }));
    EXPECT_LT(furthest_apart(world), 2e-5) << frame;
  }
  EXPECT_LT((momentum() - before).norm(), 1e-9 * before.norm());
  const Vec3 first = linear_momentum(world.bodies[0]) / world.bodies[0].masses.sum();
  EXPECT_GT(first.x(), 0.1);
}

}  // namespace
}  // namespace sprung
