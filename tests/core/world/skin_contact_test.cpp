#include "core/contact/skin_contact.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/body/forces.h"
#include "core/contact/inversion_guard.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "tests/support/horseshoe.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::closing_horseshoe;
using test::gap_of_horseshoe;
using test::test_material;
using test::touching_box;

/// Of a whole world.
Vec3 momentum_of(const World& world) {
  Vec3 sum = Vec3::Zero();
  for (const Actor& actor : world.actors) sum += linear_momentum(actor.body);
  return sum;
}

Vec3 angular_momentum_of(const World& world) {
  Vec3 sum = Vec3::Zero();
  for (const Actor& actor : world.actors) sum += angular_momentum(actor.body);
  return sum;
}

double energy(const World& world) {
  double sum = 0;
  for (const Actor& actor : world.actors) sum += energy_of(actor.body, world.gravity).sum();
  return sum;
}

Vec3 centre_of(const Actor& actor) {
  return actor.body.positions.transpose() * actor.body.masses / actor.body.masses.sum();
}

void run(World& world, double duration, double fps = 50) {
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  const long frames = std::lround(duration * fps);
  for (long frame = 0; frame < frames; ++frame) {
    static_cast<void>(motion.advance_frame(
        double(frame) / fps, 1 / fps, [](double) {}, [](const std::string& what) { FAIL() << what; }));
  }
}

/// Two cubes fly into each other a little off centre, turned so that an edge meets a face.
TEST(SkinContact, CollisionKeepsMomentumAndMakesNoEnergy) {
  World world;
  world.gravity.setZero();
  world.actors.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3), Vec3::Zero()));
  world.actors.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3, 3e4), Vec3::Zero()));
  place(world.actors[1].body, Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix(),
        Vec3(0.13, 0.01, 0.02));
  world.actors[0].body.velocities.col(0).setConstant(1);
  world.actors[1].body.velocities.col(0).setConstant(-0.5);
  const Vec3 momentum = momentum_of(world);
  const Vec3 turning = angular_momentum_of(world);
  const double before = energy(world);
  run(world, 0.3);
  const double scale = world.actors[0].body.masses.sum();
  EXPECT_LT((momentum_of(world) - momentum).norm(), 1e-9 * momentum.norm());
  EXPECT_LT((angular_momentum_of(world) - turning).norm(), 1e-3 * scale * 0.1);
  EXPECT_LT(energy(world), before * (1 + 1e-6));
  EXPECT_LT(centre_of(world.actors[0]).x(), centre_of(world.actors[1]).x());
  EXPECT_LT(linear_momentum(world.actors[0].body).x() / scale, 0.5);  // it has been stopped
}

/// A cube on a cube on the ground comes to rest there, and each carries what lies on it.
TEST(SkinContact, StackComesToRest) {
  World world;
  world.obstacles = {level_ground(0)};
  for (int i = 0; i < 3; ++i) {
    world.actors.push_back(touching_box({4, 3, 4}, 0.02, test_material(0.3, 2e5), Vec3(0, 0.062 * i + 0.001, 0)));
    world.actors.back().body.damping = {.alpha = 8, .beta = 1e-3};
  }
  run(world, 1);
  for (int i = 0; i < 3; ++i) {
    const Body& body = world.actors[i].body;
    EXPECT_NEAR(centre_of(world.actors[i]).y(), 0.03 + 0.06 * i, 0.004) << i;
    EXPECT_LT(std::sqrt(body.velocities.rowwise().squaredNorm().maxCoeff()), 0.002) << i;
    EXPECT_EQ(inverted_bricks(body), 0);
  }
  // No deeper in each other than a small part of a brick.
  for (int i = 0; i < 2; ++i) {
    const double top = world.actors[i].body.positions.col(1).maxCoeff();
    const double bottom = world.actors[i + 1].body.positions.col(1).minCoeff();
    EXPECT_LT(top - bottom, 0.0008) << i;
  }
}

/// The arms stop at each other.
TEST(SkinContact, BodyDoesNotGoThroughItself) {
  const double h = 0.01;
  const auto least_gap = [&](bool collides_with_itself) {
    World world;
    world.gravity.setZero();
    world.actors.push_back(closing_horseshoe(h));
    world.actors[0].collides_with_itself = collides_with_itself;
    double least = std::numeric_limits<double>::infinity();
    for (int frame = 0; frame < 20; ++frame) {
      run(world, 0.005, 200);
      least = std::min(least, gap_of_horseshoe(world.actors[0].body));
    }
    return least;
  };
  EXPECT_LT(least_gap(false), -0.2 * h);
  EXPECT_GT(least_gap(true), -0.05 * h);
}

/// A horseshoe far too soft for its weight falls into a heap. Skins that lie in each other there are not pushed apart
/// against bricks that have no room: that would give energy for ever, and turn bricks inside out.
TEST(SkinContact, HeapOfPressedBricksGivesNoEnergy) {
  World world;
  world.obstacles = {level_ground(0)};
  world.actors.push_back(closing_horseshoe(4));
  Actor& actor = world.actors[0];
  actor.body.velocities.col(0) *= 0.2;
  actor.body.damping.beta = 2e-3;
  stiffen_volume_guard(actor.body, world.gravity.norm(), impact_speed(world));
  double before = energy(world);
  for (int frame = 0; frame < 40; ++frame) {
    run(world, 0.7, 1 / 0.7);
    EXPECT_LT(energy(world), 1.01 * before) << frame;
    EXPECT_EQ(inverted_bricks(actor.body), 0) << frame;
    before = energy(world);
  }
  EXPECT_TRUE(is_crushed(actor.body));
}

}  // namespace
}  // namespace sprung
