#include "core/contact/swept_contacts.h"

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

/// The momentum of a whole world.
Vec3 momentum_of(const World& world) {
  Vec3 sum = Vec3::Zero();
  for (const SoftBody& body : world.bodies) sum += linear_momentum(body);
  return sum;
}

Vec3 angular_momentum_of(const World& world) {
  Vec3 sum = Vec3::Zero();
  for (const SoftBody& body : world.bodies) sum += angular_momentum(body);
  return sum;
}

double total_energy(const World& world) {
  double sum = 0;
  for (const SoftBody& body : world.bodies) sum += energy_of(body, world.gravity).sum();
  return sum;
}

Vec3 centre_of(const SoftBody& body) { return body.positions.transpose() * body.masses / body.masses.sum(); }

void run(World& world, double duration, double fps = 50) {
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  const long frames = std::lround(duration * fps);
  for (long frame = 0; frame < frames; ++frame) {
    static_cast<void>(motion.advance_frame(
        double(frame) / fps, 1 / fps, [](double) {}, [](const std::string& what) { FAIL() << what; }));
  }
}

/// Two cubes fly into each other a little off centre, turned so that an edge meets a face. Without friction they slide,
/// and the guard against crossings acts on corners of their features, which turns them a little.
class CollisionWith : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Friction, CollisionWith, testing::Values(0.0, 0.5));

TEST_P(CollisionWith, FrictionKeepsMomentumAndMakesNoEnergy) {
  World world;
  world.gravity.setZero();
  world.bodies.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3), Vec3::Zero()));
  world.bodies.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3, 3e4), Vec3::Zero()));
  place(world.bodies[1], Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix(),
        Vec3(0.13, 0.01, 0.02));
  world.bodies[0].velocities.col(0).setConstant(1);
  world.bodies[1].velocities.col(0).setConstant(-0.5);
  for (SoftBody& body : world.bodies) body.contact.friction = GetParam();
  const Vec3 momentum = momentum_of(world);
  const Vec3 turning = angular_momentum_of(world);
  const double before = total_energy(world);
  run(world, 0.3);
  const double scale = world.bodies[0].masses.sum();
  EXPECT_LT((momentum_of(world) - momentum).norm(), 1e-9 * momentum.norm());
  EXPECT_LT((angular_momentum_of(world) - turning).norm(), (GetParam() == 0 ? 3e-4 : 1e-9) * scale * 0.1);
  EXPECT_LT(total_energy(world), before * (1 + 1e-6));
  EXPECT_LT(centre_of(world.bodies[0]).x(), centre_of(world.bodies[1]).x());
  EXPECT_LT(linear_momentum(world.bodies[0]).x() / scale, 0.5);  // it has been stopped
}

/// A cube on a cube on the ground comes to rest there, and each carries what lies on it.
TEST(SweptContacts, StackComesToRest) {
  World world;
  world.obstacles = {level_ground(0)};
  for (int i = 0; i < 3; ++i) {
    world.bodies.push_back(touching_box({4, 3, 4}, 0.02, test_material(0.3, 2e5), Vec3(0, 0.062 * i + 0.001, 0)));
    world.bodies.back().damping = {.alpha = 8, .beta = 1e-3};
  }
  run(world, 1);
  for (int i = 0; i < 3; ++i) {
    const Body& body = world.bodies[i];
    EXPECT_NEAR(centre_of(world.bodies[i]).y(), 0.03 + 0.06 * i, 0.004) << i;
    EXPECT_LT(std::sqrt(body.velocities.rowwise().squaredNorm().maxCoeff()), 0.002) << i;
    EXPECT_EQ(inverted_bricks(body), 0);
  }
  // They overlap by no more than a small fraction of a brick.
  for (int i = 0; i < 2; ++i) {
    const double top = world.bodies[i].positions.col(1).maxCoeff();
    const double bottom = world.bodies[i + 1].positions.col(1).minCoeff();
    EXPECT_LT(top - bottom, 0.0008) << i;
  }
}

/// The arms stop each other.
TEST(SweptContacts, BodyDoesNotGoThroughItself) {
  const double h = 0.01;
  const auto min_gap = [&](bool collides_with_itself) {
    World world;
    world.gravity.setZero();
    world.bodies.push_back(closing_horseshoe(h));
    world.bodies[0].contact.with_itself = collides_with_itself;
    double least = std::numeric_limits<double>::infinity();
    for (int frame = 0; frame < 20; ++frame) {
      run(world, 0.005, 200);
      least = std::min(least, gap_of_horseshoe(world.bodies[0]));
    }
    return least;
  };
  EXPECT_LT(min_gap(false), -0.2 * h);
  EXPECT_GT(min_gap(true), -0.05 * h);
}

/// Contacts found in a frame do not depend on earlier frames: a motion can be resumed where it was left. Between two
/// frames a body is put elsewhere, as when a frame is rolled back.
TEST(SweptContacts, BeginAnewWithEveryFrame) {
  const auto positions_after = [](bool keeps_integrator) {
    World world;
    world.obstacles = {level_ground(0)};
    for (int i = 0; i < 3; ++i) {
      world.bodies.push_back(
          touching_box({3, 3, 3}, 0.02, test_material(0.3, 5e4), Vec3(0.004 * i, 0.062 * i + 0.001, 0)));
    }
    AdaptiveIntegrator kept(world, Scheme::kSymplecticEuler);
    for (int frame = 0; frame < 20; ++frame) {
      AdaptiveIntegrator made(world, Scheme::kSymplecticEuler);
      static_cast<void>(
          (keeps_integrator ? kept : made)
              .advance_frame(
                  frame / 50.0, 1 / 50.0, [](double) {}, [](const std::string& what) { FAIL() << what; }));
      if (frame == 10) world.bodies[2].positions.col(1).array() += 0.03;
    }
    Points all(0, 3);
    for (const SoftBody& body : world.bodies) {
      all.conservativeResize(all.rows() + body.node_count(), 3);
      all.bottomRows(body.node_count()) = body.positions;
    }
    return all;
  };
  const Points kept = positions_after(true);
  EXPECT_EQ(kept, positions_after(false));
  EXPECT_GT(kept.col(1).minCoeff(), -0.001) << "nothing in the ground";
}

/// A horseshoe far too soft for its weight falls into a heap. Overlapping skins are not pushed apart there against
/// bricks that have no room: that would add energy for ever, and invert bricks.
TEST(SweptContacts, HeapOfPressedBricksGivesNoEnergy) {
  World world;
  world.obstacles = {level_ground(0)};
  world.bodies.push_back(closing_horseshoe(1));
  SoftBody& body = world.bodies[0];
  body.velocities.col(0) *= 0.2;
  body.damping.beta = 2e-3;
  double before = total_energy(world);
  for (int frame = 0; frame < 40; ++frame) {
    run(world, 0.7, 1 / 0.7);
    EXPECT_LT(total_energy(world), 1.01 * before) << frame;
    EXPECT_EQ(inverted_bricks(body), 0) << frame;
    before = total_energy(world);
  }
}

}  // namespace
}  // namespace sprung
