#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>

#include "core/body/forces.h"
#include "core/contact/glue.h"
#include "core/contact/pairs/awake_pair.h"
#include "core/contact/search/contact_surface.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "core/error.h"
#include "tests/support/horseshoe.h"
#include "tests/support/touching.h"

/// Bodies that touch each other and themselves, and glue, in implicit steps.
namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

Vec3 centre_of(const SoftBody& body) { return body.positions.transpose() * body.masses / body.masses.sum(); }

double energy(const World& world) {
  double sum = 0;
  for (const SoftBody& body : world.bodies) sum += energy_of(body, world.gravity).sum();
  return sum;
}

void run_by_explicit_steps(World& world, int frames) {
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  for (int frame = 0; frame < frames; ++frame) {
    static_cast<void>(motion.advance_frame(
        frame * 0.02, 0.02, [](double) {}, [](const std::string& what) { ADD_FAILURE() << what; }));
  }
}

/// A soft block under a stiffer one of other bricks.
World two_stacked() {
  World world;
  world.obstacles = {level_ground(0)};
  world.bodies.push_back(touching_box({3, 2, 3}, 0.02, test_material(0.3, 2e4), {0, 0.001, 0}));
  world.bodies.push_back(touching_box({3, 3, 3}, 0.015, test_material(0.3, 1e5), {0.005, 0.043, 0.004}));
  for (SoftBody& body : world.bodies) body.damping = {.alpha = 8, .beta = 2e-3};
  return world;
}

/// Their own weight compresses the lower one by some 0.9 mm.
TEST(ImplicitTouch, StackRestsAtTheHeightsOfExplicitSteps) {
  World explicit_world = two_stacked();
  run_by_explicit_steps(explicit_world, 50);
  for (const ImplicitScheme scheme : {ImplicitScheme::kEuler, ImplicitScheme::kBdf2}) {
    World world = two_stacked();
    ImplicitMotion(world, {.scheme = scheme}).advance(0.02, 50, 0);
    for (std::size_t i = 0; i < 2; ++i) {
      const double gaps = kGuardedGap * (i == 0 ? 0.02 : 0.02 + 0.015);  // of explicit steps
      EXPECT_NEAR(centre_of(world.bodies[i]).y() + gaps, centre_of(explicit_world.bodies[i]).y(), 1e-4) << i;
      EXPECT_LT(world.bodies[i].velocities.rowwise().norm().maxCoeff(), 2e-3) << i;
    }
  }
}

/// Two cubes fly into each other a little off centre, turned so that an edge meets a face.
World two_colliding() {
  World world;
  world.gravity.setZero();
  world.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3::Zero()));
  world.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3, 3e4), Vec3::Zero()));
  place(world.bodies[1], Eigen::AngleAxisd(0.7, Vec3(1, 2, 0.5).normalized()).toRotationMatrix(),
        Vec3(0.1, 0.01, 0.02));
  world.bodies[0].velocities.col(0).setConstant(1);
  world.bodies[1].velocities.col(0).setConstant(-0.5);
  return world;
}

TEST(ImplicitTouch, CollisionKeepsMomentumAndMakesNoEnergy) {
  for (const ImplicitScheme scheme : {ImplicitScheme::kEuler, ImplicitScheme::kBdf2}) {
    World world = two_colliding();
    const double mass = world.bodies[0].masses.sum();
    const double start = energy(world);
    const auto momentum = [&] { return Vec3(linear_momentum(world.bodies[0]) + linear_momentum(world.bodies[1])); };
    const Vec3 before = momentum();
    ImplicitMotion motion(world, {.scheme = scheme, .tolerance = 1e-6});
    for (int step = 0; step < 24; ++step) {
      motion.advance(0.006, 1, 0.006 * step);
      EXPECT_LT(energy(world), start * (1 + 1e-6)) << step;
    }
    EXPECT_LT((momentum() - before).norm(), 1e-4 * mass);
    EXPECT_LT(linear_momentum(world.bodies[0]).x() / mass, 0.5);  // it has been stopped
    EXPECT_GT(centre_of(world.bodies[1]).x() - centre_of(world.bodies[0]).x(), 0.05);
  }
}

/// However long the steps: plates of one brick do not fly through each other.
TEST(ImplicitTouch, FastPlatesMeetInLongSteps) {
  World world;
  world.gravity.setZero();
  for (const double side : {-1.0, 1.0}) {
    world.bodies.push_back(touching_box({1, 4, 4}, 0.01, test_material(0.3, 1e6), {side * 0.05, 0, 0}));
    world.bodies.back().velocities.col(0).setConstant(-3 * side);
  }
  ImplicitMotion(world, {.scheme = ImplicitScheme::kEuler}).advance(0.02, 3, 0);
  EXPECT_GT(centre_of(world.bodies[1]).x() - centre_of(world.bodies[0]).x(), 0.009);
  EXPECT_LT(linear_momentum(world.bodies[0]).x(), 0.5 * 3 * world.bodies[0].masses.sum());
}

/// The arms of a horseshoe stop each other.
TEST(ImplicitTouch, BodyDoesNotGoThroughItself) {
  const double h = 0.01;
  const auto min_gap = [&](bool collides_with_itself) {
    World world;
    world.gravity.setZero();
    world.bodies.push_back(test::closing_horseshoe(h));
    world.bodies[0].contact.with_itself = collides_with_itself;
    ImplicitMotion motion(world, {});
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 20; ++step) {
      motion.advance(0.005, 1, 0);
      least = std::min(least, test::gap_of_horseshoe(world.bodies[0]));
    }
    return least;
  };
  EXPECT_LT(min_gap(false), -0.2 * h);
  EXPECT_GT(min_gap(true), -0.1 * h);
}

double furthest_apart(const World& world) {
  double furthest = 0;
  for (const GluedPoint& point : world.glue) {
    const auto place = [&](std::size_t side) {
      const Body& body = world.bodies[point.bodies[side]];
      return carried(body, point.bricks[side], point.weights[side], body.positions);
    };
    furthest = std::max(furthest, (place(0) - place(1)).norm());
  }
  return furthest;
}

/// A block hangs by its glue from another that is pinned, as low as in explicit steps.
TEST(ImplicitTouch, GlueHoldsWhatHangs) {
  const auto make = [] {
    World world;
    world.bodies.push_back(touching_box({3, 3, 3}, 0.01, test_material(0.3, 2e4), Vec3::Zero()));
    world.bodies.push_back(touching_box({2, 2, 2}, 0.014, test_material(0.3, 8e4), {0.001, -0.02801, 0.001}));
    world.glue = glue_between(world, 0, 1, 0.001);
    SoftBody& upper = world.bodies[0];
    for (int node = 0; node < upper.node_count(); ++node) {
      if (upper.grid.lattice[node].y() == 3) upper.pinned.push_back({.node = node});
    }
    for (SoftBody& body : world.bodies) body.damping = {.alpha = 8, .beta = 2e-3};
    return world;
  };
  World explicit_world = make();
  run_by_explicit_steps(explicit_world, 50);
  World world = make();
  ASSERT_FALSE(world.glue.empty());
  const double start = centre_of(world.bodies[1]).y();
  ImplicitMotion(world, {}).advance(0.02, 50, 0);
  const double sag = start - centre_of(explicit_world.bodies[1]).y();
  EXPECT_GT(sag, 1e-4);
  EXPECT_NEAR(start - centre_of(world.bodies[1]).y(), sag, 0.05 * sag);
  EXPECT_LT(furthest_apart(world), 1e-4);
}

TEST(ImplicitTouch, SameBitsForAnyNumberOfThreads) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    World world = two_stacked();
    ImplicitMotion(world, {}).advance(0.01, 12, 0);
    return std::pair(world.bodies[0].positions, world.bodies[1].positions);
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(4));
}

/// Blocks that start a third of a brick inside each other separate slowly, without an impulse.
TEST(ImplicitTouch, WhatBeginsInsideIsLifted) {
  World world;
  world.obstacles = {level_ground(0)};
  world.bodies.push_back(touching_box({2, 2, 2}, 0.01, test_material(0.3, 1e6), Vec3::Zero()));
  world.bodies.push_back(touching_box({2, 2, 2}, 0.01, test_material(0.3, 1e6), {0.017, 0, 0.001}));
  ImplicitMotion(world, {}).advance(0.01, 60, 0);
  const Points& left = world.bodies[0].positions;
  const Points& right = world.bodies[1].positions;
  EXPECT_GT(right.col(0).minCoeff() - left.col(0).maxCoeff(), -0.0005);
  for (const SoftBody& body : world.bodies) EXPECT_LT(largest_speed(body), 0.05);
}

/// A stiff block that starts inside the ground would shoot out of it.
TEST(ImplicitTouch, EnergyFromNowhereIsNotLetPass) {
  World world;
  world.gravity.setZero();
  world.bodies.push_back(touching_box({2, 2, 2}, 0.01, test_material(0.3, 1e6), {0, -0.005, 0}));
  world.obstacles = {level_ground(0)};
  try {
    ImplicitMotion(world, {}).advance(0.01, 20, 0.5);
    FAIL() << "it passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kDiverged);
    EXPECT_NE(std::string(error.what()).find("spurious energy gain"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0.5"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sprung
