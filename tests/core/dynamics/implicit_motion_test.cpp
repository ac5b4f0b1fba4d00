#include "core/dynamics/implicit/implicit_motion.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>

#include "core/body/forces.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "tests/support/bodies.h"
#include "tests/support/calibrated_box.h"
#include "tests/support/error_message.h"
#include "tests/support/worlds.h"

namespace sprung {
namespace {

using test::calibrated_box;
using test::shake;
using test::test_material;
using test::world_of;

constexpr double kStandardGravity = 9.81;

void pin_left_end(SoftBody& body) {
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == 0) body.pinned.push_back({.node = node});
  }
}

double energy(const Body& body) { return elastic_energy(body) + kinetic_energy(body); }

TEST(Implicit, FreeFallIsTheClosedForm) {
  const double dt = 0.01;
  const long steps = 20;
  const auto n = double(steps);
  for (const ImplicitScheme scheme : {ImplicitScheme::kEuler, ImplicitScheme::kBdf2}) {
    World world = world_of(calibrated_box({2, 2, 2}, 0.1, 0.3), {0, -kStandardGravity, 0});
    const Points start = world.bodies[0].positions;
    ImplicitMotion(world, {.scheme = scheme}).advance(dt, steps, 0);
    const Points fall = start - world.bodies[0].positions;
    // Backward Euler: the sum of an arithmetic series. BDF2 starts with one such step; what that is off by grows to
    // three halves of itself.
    const double exact = kStandardGravity * n * n * dt * dt / 2;
    const double drop = scheme == ImplicitScheme::kEuler ? kStandardGravity * dt * dt * n * (n + 1) / 2
                                                         : exact + 0.75 * kStandardGravity * dt * dt;
    EXPECT_LT((fall.col(1).array() - drop).abs().maxCoeff(), 1e-6) << int(scheme);
    EXPECT_NEAR(world.bodies[0].velocities(0, 1), -kStandardGravity * n * dt, 1e-6);
  }
}

/// Classical Runge-Kutta of the fourth order, free bodies only: the reference.
void runge_kutta(Body& body, double dt, long steps) {
  ForceWorkspace workspace;
  Points forces;
  const auto acceleration = [&](const Points& x, const Points& v) -> Points {
    body.positions = x;
    body.velocities = v;
    spring_forces(body, workspace, forces);
    return body.masses.cwiseInverse().asDiagonal() * forces - body.damping.alpha * v;
  };
  for (long step = 0; step < steps; ++step) {
    const Points x = body.positions;
    const Points v = body.velocities;
    const Points a1 = acceleration(x, v);
    const Points v2 = v + dt / 2 * a1;
    const Points a2 = acceleration(x + dt / 2 * v, v2);
    const Points v3 = v + dt / 2 * a2;
    const Points a3 = acceleration(x + dt / 2 * v2, v3);
    const Points v4 = v + dt * a3;
    const Points a4 = acceleration(x + dt * v3, v4);
    body.positions = x + dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
    body.velocities = v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
}

/// A stretched, rotating, damped bar, released.
Body released() {
  Body body = calibrated_box({4, 1, 1}, 0.02, 0.3);
  body.damping = {.alpha = 2, .beta = 2e-4};
  for (int i = 0; i < body.node_count(); ++i) {
    body.positions(i, 0) *= 1 + 0.1 * body.rest_positions(i, 0) / 0.08;
    body.velocities.row(i) << 0, 0.2 * body.rest_positions(i, 0), 0;
  }
  return body;
}

constexpr double kTime = 0.016;

/// Positions at kTime, reached in that many steps.
template <class Move>
Points positions_after(const Move& move, long steps) {
  World world = world_of(released());
  move(world, kTime / double(steps), steps);
  return world.bodies[0].positions;
}

template <class Move>
double measured_order(const Move& move, long steps) {
  Body reference = released();
  runge_kutta(reference, kTime / 2048, 2048);
  const double coarse = (positions_after(move, steps) - reference.positions).norm();
  const double fine = (positions_after(move, 2 * steps) - reference.positions).norm();
  return std::log2(coarse / fine);
}

TEST(Implicit, EverySchemeHasItsOrder) {
  const auto explicit_by = [](Scheme scheme) {
    return [scheme](World& world, double dt, long steps) { advance(world, scheme, dt, steps, 0); };
  };
  const auto implicit_by = [](ImplicitScheme scheme) {
    return [scheme](World& world, double dt, long steps) {
      ImplicitMotion(world, {.scheme = scheme, .tolerance = 1e-11}).advance(dt, steps, 0);
    };
  };
  EXPECT_NEAR(measured_order([](World& world, double dt, long steps) { runge_kutta(world.bodies[0], dt, steps); }, 32),
              4, 0.3);
  EXPECT_NEAR(measured_order(explicit_by(Scheme::kSymplecticEuler), 128), 1, 0.2);
  EXPECT_NEAR(measured_order(implicit_by(ImplicitScheme::kEuler), 128), 1, 0.2);
  EXPECT_NEAR(measured_order(implicit_by(ImplicitScheme::kBdf2), 128), 2, 0.3);
}

TEST(Implicit, EnergyNeverGrows) {
  for (const ImplicitScheme scheme : {ImplicitScheme::kEuler, ImplicitScheme::kBdf2}) {
    std::mt19937 random(3);
    World world = world_of(calibrated_box({3, 2, 2}, 0.02, 0.4));
    Body& body = world.bodies[0];
    body.damping = {};
    shake(body, 0.2, random);
    const double start = energy(body);
    double last = start;
    ImplicitMotion motion(world, {.scheme = scheme, .tolerance = 1e-9});
    for (int step = 0; step < 40; ++step) {
      motion.advance(2 * stable_step(world), 1, 0);
      // BDF2's own measure of energy falls; the body's may waver a little below where it started.
      EXPECT_LE(energy(body), scheme == ImplicitScheme::kEuler ? (1 + 1e-9) * last : start);
      last = energy(body);
    }
    EXPECT_LT(last, 0.5 * start);
  }
}

TEST(Implicit, LongStepsEndInTheStaticEquilibrium) {
  World world = world_of(calibrated_box({12, 3, 3}, 0.02, 0.3, 5e4), {0, -kStandardGravity, 0});
  SoftBody& body = world.bodies[0];
  pin_left_end(body);
  Body still = body;
  Supports supports(still.node_count());
  for (const KinematicNode& pinned : body.pinned) supports.fix(pinned.node);
  const Points loads = still.masses * world.gravity.transpose();
  const auto system = make_direct_solver();
  const Points start = still.positions;
  solve_static(still, supports, loads, start, *system);
  ImplicitMotion(world, {.scheme = ImplicitScheme::kEuler, .tolerance = 1e-9}).advance(1, 12, 0);
  EXPECT_LT((body.positions - still.positions).norm(), 1e-6 * (start - still.positions).norm());
  EXPECT_LT(body.velocities.norm(), 1e-6);
}

TEST(Implicit, HandlesMoveAsTold) {
  World world = world_of(calibrated_box({4, 2, 2}, 0.02, 0.3));
  SoftBody& body = world.bodies[0];
  pin_left_end(body);
  for (KinematicNode& pinned : body.pinned) {
    pinned.velocity = {0.1, 0.2, 0};
    pinned.axes = {true, true, false};
  }
  const Points start = body.positions;
  ImplicitMotion(world, {}).advance(0.01, 10, 0);
  for (const KinematicNode& pinned : body.pinned) {
    EXPECT_NEAR(body.positions(pinned.node, 0), start(pinned.node, 0) + 0.01, 1e-12);
    EXPECT_NEAR(body.positions(pinned.node, 1), start(pinned.node, 1) + 0.02, 1e-12);
  }
  EXPECT_GT((body.positions - start).col(1).mean(), 0.005);
}

/// Explicit and implicit steps of the same fall agree.
TEST(Implicit, AgreesWithExplicitStepsOnABendingBeam) {
  const auto make = [] {
    World world = world_of(calibrated_box({12, 2, 2}, 0.02, 0.3, 5e4), {0, -kStandardGravity, 0});
    pin_left_end(world.bodies[0]);
    world.bodies[0].damping.beta = 5e-4;
    return world;
  };
  World explicit_world = make();
  World implicit_world = make();
  test::advance_by_stable_steps(explicit_world, Scheme::kVerlet, 0.25);
  ImplicitMotion(implicit_world, {}).advance(0.0025, 100, 0);
  const Points start = implicit_world.bodies[0].rest_positions;
  const double way = (explicit_world.bodies[0].positions - start).norm();
  EXPECT_LT((explicit_world.bodies[0].positions - implicit_world.bodies[0].positions).norm(), 0.02 * way);
}

TEST(Implicit, ForcesBendABeamAsTheStaticsDo) {
  World world = world_of(calibrated_box({8, 2, 2}, 0.02, 0.3, 5e4), {0, 0, 0});
  SoftBody& body = world.bodies[0];
  pin_left_end(body);
  body.loads.forces = Points::Zero(body.node_count(), 3);
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == 8) body.loads.forces(node, 1) = -2e-3;
  }
  Body still = body;
  Supports supports(still.node_count());
  for (const KinematicNode& pinned : body.pinned) supports.fix(pinned.node);
  const auto system = make_direct_solver();
  solve_static(still, supports, body.loads.forces, Points(still.positions), *system);
  ImplicitMotion(world, {.scheme = ImplicitScheme::kEuler, .tolerance = 1e-9}).advance(1, 12, 0);
  const double way = (still.positions - still.rest_positions).norm();
  EXPECT_GT(way, 0.01);
  EXPECT_LT((body.positions - still.positions).norm(), 1e-3 * way);
}

/// Each brick of a beam pulls along a direction of its own frame, on one side only: the beam curls up by more than its
/// thickness, as far as explicit steps bring it.
TEST(Implicit, MusclesCurlABeamAsInExplicitSteps) {
  const auto make = [] {
    World world = world_of(calibrated_box({10, 2, 2}, 0.02, 0.3, 5e4));
    SoftBody& body = world.bodies[0];
    pin_left_end(body);
    body.damping = {.alpha = 6, .beta = 2e-3};
    Muscle muscle{.bricks = {}, .direction = Vec3::UnitX(), .contraction = 0.25};
    for (int brick = 0; brick < body.grid.brick_count(); ++brick) {
      if (body.grid.cells[brick].y() == 1) muscle.bricks.push_back(brick);
    }
    body.loads.muscles = {muscle};
    return world;
  };
  World explicit_world = make();
  test::advance_by_stable_steps(explicit_world, Scheme::kSymplecticEuler, 3);
  World implicit_world = make();
  ImplicitMotion(implicit_world, {.scheme = ImplicitScheme::kEuler}).advance(0.05, 60, 0);
  const Body& body = implicit_world.bodies[0];
  EXPECT_GT((body.positions - body.rest_positions).col(1).maxCoeff(), 0.06);
  const double way = (body.positions - body.rest_positions).norm();
  EXPECT_LT((body.positions - explicit_world.bodies[0].positions).norm(), 0.01 * way);
}

TEST(Implicit, SameBitsForAnyNumberOfThreads) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    World world = world_of(calibrated_box({10, 6, 6}, 0.02, 0.4), {0, -kStandardGravity, 0});
    world.obstacles = {level_ground(-0.01, 0.5, 0)};
    ImplicitMotion(world, {}).advance(0.01, 8, 0);
    return world.bodies[0].positions;
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(Implicit, WhatCannotBeIsRefused) {
  World world = world_of(calibrated_box({2, 1, 1}, 0.02, 0.3));
  world.obstacles = {level_ground(-1, 0, 0.5)};
  EXPECT_THROW(ImplicitMotion(world, {}), Error);
  world.obstacles.clear();
  world.bodies[0].positions(3, 1) = std::nan("");
  const std::string message =
      error_message(ErrorKind::kDiverged, [&] { ImplicitMotion(world, {}).advance(0.01, 1, 0.25); });
  EXPECT_NE(message.find("body 1"), std::string::npos) << message;
  EXPECT_NE(message.find("0.25"), std::string::npos) << message;
}

}  // namespace
}  // namespace sprung
