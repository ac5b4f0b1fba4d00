#include "core/contact/pairs/crossing_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "core/body/brick_model.h"
#include "core/body/forces.h"
#include "core/contact/search/obstacle_surface.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/mesh/surface_mesh.h"
#include "core/world/make_soft_body.h"
#include "tests/support/horseshoe.h"
#include "tests/support/meshes.h"
#include "tests/support/passes_through.h"
#include "tests/support/touching.h"

/// Crossings of surfaces are found by testing every edge of one against every triangle of the other.
namespace sprung {
namespace {

using test::passes_through;
using test::test_material;
using test::touching_box;

/// A contact surface at its position.
struct PlacedSurface {
  std::vector<Vec3> positions;
  const ContactSurface* skin;

  explicit PlacedSurface(SoftBody& body) : skin(&contact_surface_of(body)) {
    for (const ContactPoint& point : skin->points) positions.push_back(carried(body, point, body.positions));
  }
};

/// Crossings of edges of one through triangles of the other; within one surface only those without a common corner.
int crossings_through(const PlacedSurface& edges_of, const PlacedSurface& triangles_of) {
  int count = 0;
  for (const std::array<int, 3>& from : edges_of.skin->triangles) {
    for (int side = 0; side < 3; ++side) {
      const int p = from[side];
      const int q = from[(side + 1) % 3];
      for (const auto& [a, b, c] : triangles_of.skin->triangles) {
        if (edges_of.skin == triangles_of.skin && (p == a || p == b || p == c || q == a || q == b || q == c)) continue;
        const Vec3& start = edges_of.positions[p];
        const Vec3& end = edges_of.positions[q];
        count +=
            passes_through(start, end, triangles_of.positions[a], triangles_of.positions[b], triangles_of.positions[c])
                ? 1
                : 0;
      }
    }
  }
  return count;
}

int crossings(SoftBody& one, SoftBody& other) {
  const PlacedSurface a(one);
  const PlacedSurface b(other);
  return crossings_through(a, b) + (&one == &other ? 0 : crossings_through(b, a));
}

/// Moves a world with the guard, and counts crossings of bodies with each other and with obstacles at every frame.
int run_and_count(World& world, double duration, double fps = 100) {
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  std::vector<std::unique_ptr<SoftBody>> obstacles;
  for (const Obstacle& obstacle : world.obstacles) {
    if (has_edges(obstacle.shape)) {
      obstacles.push_back(std::make_unique<SoftBody>(obstacle_surface(obstacle, 0.02)));
    }
  }
  int count = 0;
  for (long frame = 0; frame < std::lround(duration * fps); ++frame) {
    static_cast<void>(motion.advance_frame(
        double(frame) / fps, 1 / fps, [](double) {}, [](const std::string& what) { ADD_FAILURE() << what; }));
    for (std::size_t a = 0; a < world.bodies.size(); ++a) {
      for (std::size_t b = a + 1; b < world.bodies.size(); ++b) count += crossings(world.bodies[a], world.bodies[b]);
      for (std::size_t i = 0; i < obstacles.size(); ++i) {
        move_surface(world.obstacles[i], 0, 1e-3, *obstacles[i]);
        count += crossings(world.bodies[a], *obstacles[i]);
      }
    }
  }
  return count;
}

/// A roof along z, its ridge at the origin.
Obstacle knife(double degrees = 60) {
  Points points(6, 3);
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  points << 0, 0, -0.2, -0.1, -0.1 * slope, -0.2, 0.1, -0.1 * slope, -0.2, 0, 0, 0.2, -0.1, -0.1 * slope, 0.2, 0.1,
      -0.1 * slope, 0.2;
  Triangles triangles(8, 3);
  triangles << 0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 0, 3, 5, 0, 5, 2, 1, 2, 5, 1, 5, 4;
  Obstacle obstacle;
  obstacle.shape = MeshSolid{std::make_shared<const MeshDistance>(points, triangles)};
  return obstacle;
}

/// Two bars fly at each other crosswise, turned so that an edge of one meets an edge of the other.
World crossed_edges() {
  World world;
  world.gravity.setZero();
  const Mat3 on_edge = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()).toRotationMatrix();
  const Mat3 across = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()).toRotationMatrix();
  for (int i = 0; i < 2; ++i) {
    world.bodies.push_back(touching_box({8, 2, 2}, 0.02, test_material(0.3), Vec3::Zero()));
    SoftBody& body = world.bodies.back();
    place(body, Mat3::Identity(), Vec3(-0.08, -0.02, -0.02));
    place(body, i == 0 ? on_edge : Mat3(across * on_edge), Vec3(0, i == 0 ? 0 : 0.08, 0));
    body.velocities.col(1).setConstant(i == 0 ? 1 : -1);
  }
  return world;
}

TEST(CrossingGuard, HoldsEdgesOnEdges) {
  World world = crossed_edges();
  EXPECT_EQ(run_and_count(world, 0.1), 0);
  World free = crossed_edges();
  free.bodies_collide = false;
  AdaptiveIntegrator motion(free, Scheme::kSymplecticEuler);
  int count = 0;
  for (int frame = 0; frame < 10; ++frame) {
    static_cast<void>(motion.advance_frame(
        0.01 * frame, 0.01, [](double) {}, [](const std::string&) {}));
    count += crossings(free.bodies[0], free.bodies[1]);
  }
  EXPECT_GT(count, 0) << "the scene is no test: nothing crosses without contact";
}

TEST(CrossingGuard, KeepsMomentum) {
  World world = crossed_edges();
  world.bodies[1].velocities.rowwise() += Eigen::RowVector3d(0.3, 0, 0.1);
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (const SoftBody& body : world.bodies) sum += linear_momentum(body);
    return sum;
  };
  const auto turning = [&] {
    Vec3 sum = Vec3::Zero();
    for (const SoftBody& body : world.bodies) sum += angular_momentum(body);
    return sum;
  };
  const Vec3 momentum_before = momentum();
  const Vec3 turning_before = turning();
  const double mass = world.bodies[0].masses.sum();
  EXPECT_EQ(run_and_count(world, 0.1), 0);
  EXPECT_LT((momentum() - momentum_before).norm(), 1e-9 * mass);
  EXPECT_LT((turning() - turning_before).norm(), 0.1 * turning_before.norm());
}

TEST(CrossingGuard, NoKnifeCutsIn) {
  for (const double angle : {0.0, 0.3, std::numbers::pi / 4}) {
    World world;
    world.obstacles.push_back(knife());
    world.bodies.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3), Vec3::Zero()));
    place(world.bodies[0], Mat3::Identity(), Vec3(-0.04, -0.04, -0.04));
    place(world.bodies[0], Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), Vec3(0.003, 0.08, 0));
    world.bodies[0].velocities.col(1).setConstant(-1.5);
    EXPECT_EQ(run_and_count(world, 0.2), 0) << angle;
  }
}

/// Boxes of random shapes, speeds and spins meet, two to four at a time, in the air or on a knife, so hard that many
/// bricks are crushed until they are inside out.
World violent_collision(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * double(random()) / double(std::mt19937::max());
  };
  const auto vector = [&](double size) {
    return Vec3(between(-size, size), between(-size, size), between(-size, size));
  };
  World world;
  const bool has_knife = seed % 2 == 0;
  if (has_knife) {
    world.obstacles.push_back(knife(between(45, 80)));
  } else {
    world.gravity.setZero();
  }
  const Material material = test_material(between(0, 0.45));
  const int count = 2 + int(seed % 3);
  for (int i = 0; i < count; ++i) {
    const Vec3 towards = vector(1).normalized();
    world.bodies.push_back(touching_box({4, 3, 2}, 0.02, material, Vec3::Zero()));
    SoftBody& body = world.bodies.back();
    place(body, Mat3::Identity(), Vec3(-0.04, -0.03, -0.02));
    const Vec3 middle = has_knife ? Vec3(between(-0.02, 0.02), 0.08 + 0.11 * i, between(-0.02, 0.02))
                                  : Vec3((0.08 + 0.06 * i) * towards);
    place(body, Eigen::AngleAxisd(between(0, 6), vector(1).normalized()).toRotationMatrix(), middle);
    const Vec3 velocity = has_knife ? Vec3(0, -between(1, 3), 0) : Vec3(-between(1, 3) * towards);
    const Vec3 spin = vector(9);
    for (int node = 0; node < body.node_count(); ++node) {
      const Vec3 arm = body.positions.row(node).transpose() - middle;
      body.velocities.row(node) = (velocity + spin.cross(arm)).transpose();
    }
  }
  return world;
}

TEST(CrossingGuard, NothingCrossesHoweverHardBodiesMeet) {
  for (const unsigned seed : {5U, 8U, 14U, 28U, 38U}) {
    World world = violent_collision(seed);
    EXPECT_EQ(run_and_count(world, 0.2, 50), 0) << seed;
  }
}

/// The guard's counts in a frame of 10 ms.
GuardCounts counts_of_frame(World& world) {
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  static_cast<void>(motion.advance_frame(
      0, 0.01, [](double) {}, [](const std::string& what) { ADD_FAILURE() << what; }));
  return motion.report().guard;
}

TEST(CrossingGuard, CountsTheStepsInWhichItActs) {
  World world;
  world.obstacles.push_back(knife());
  world.bodies.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3), Vec3(-0.037, 0.001, -0.04)));
  world.bodies[0].velocities.col(1).setConstant(-8);
  const GuardCounts counts = counts_of_frame(world);
  EXPECT_GT(counts.impulses, 0);
  EXPECT_GE(counts.steps, counts.impulses);
  EXPECT_GE(counts.impulses, counts.slowed);
  EXPECT_GE(counts.slowed, counts.welded);
  EXPECT_EQ(counts.failed, 0);
}

/// Nearest points that coincide have no direction between them: the surfaces do.
TEST(CrossingGuard, MovesNothingAsOneThatTouchesExactlyAtTheStart) {
  World world;
  Obstacle table;
  table.shape = SolidBox{Vec3(0.1, 0.01, 0.1)};
  table.pose.translation.y() = -0.01;
  world.obstacles.push_back(table);
  world.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3::Zero()));
  world.bodies.push_back(touching_box({2, 2, 2}, 0.02, test_material(0.3), Vec3(0.01, 0.06, 0.02)));
  const GuardCounts counts = counts_of_frame(world);
  EXPECT_GT(counts.impulses, 0);
  EXPECT_EQ(counts.welded, 0);
}

/// Blocks that overlap by 0.2 mm, and beside each other by a tenth of a millimetre, come apart and stand.
TEST(CrossingGuard, LetsOutWhatOverlapsAtTheStart) {
  World world;
  world.obstacles.push_back(level_ground(0));
  const std::array<Vec3, 4> corners{Vec3(0, 0.0005, 0), Vec3(1e-4, 0.0303, -1e-4), Vec3(-1e-4, 0.0601, 1e-4),
                                    Vec3(1e-4, 0.0899, 2e-4)};
  for (const Vec3& corner : corners) {
    world.bodies.push_back(touching_box({5, 3, 5}, 0.01, test_material(0.3, 2e6), corner));
    world.bodies.back().damping = {.alpha = 8, .beta = 1e-4};
  }
  ASSERT_GT(crossings(world.bodies[1], world.bodies[2]), 0) << "the scene is no test";
  GuardCounts counts;
  double highest = 0;
  for (int frame = 0; frame < 40; ++frame) {
    counts += counts_of_frame(world);
    highest = std::max(highest, world.bodies[3].positions.col(1).maxCoeff());
  }
  EXPECT_LT(double(counts.impulses), 0.05 * double(counts.steps));
  EXPECT_EQ(counts.failed, 0);
  EXPECT_LT(highest, 0.0899 + 0.03 + 0.002) << "shot";
  for (std::size_t row = 1; row < 4; ++row) {
    EXPECT_EQ(crossings(world.bodies[row - 1], world.bodies[row]), 0) << row;
    const Vec3 moved = world.bodies[row].positions.colwise().mean() - world.bodies[row].rest_positions.colwise().mean();
    EXPECT_LT(moved.norm(), 1.5e-3) << row;
    EXPECT_LT(world.bodies[row].velocities.colwise().mean().norm(), 5e-3) << row;
  }
}

/// A box on the ground, whose lower nodes are pinned and move at `velocity` (m/s).
World box_with_feet(double velocity) {
  World world;
  world.obstacles.emplace_back();
  world.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3::Zero()));
  SoftBody& body = world.bodies[0];
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.positions(node, 1) == 0) body.pinned.push_back({.node = node, .velocity = Vec3(0, velocity, 0)});
  }
  return world;
}

TEST(CrossingGuard, LeavesPinsAloneThatTouchTheGround) {
  World world = box_with_feet(0);
  const GuardCounts counts = counts_of_frame(world);
  EXPECT_GT(counts.steps, 0);
  EXPECT_EQ(counts.impulses, 0);
  EXPECT_EQ(counts.failed, 0);
}

TEST(CrossingGuard, CountsAFailureWherePinsMoveIntoTheGround) {
  World world = box_with_feet(-0.1);
  EXPECT_GT(counts_of_frame(world).failed, 0);
}

/// The ends of a horseshoe come down on each other.
TEST(CrossingGuard, ABodyDoesNotPassThroughItself) {
  World world;
  world.gravity.setZero();
  world.bodies.push_back(test::closing_horseshoe(0.02));
  for (int part = 0; part < 10; ++part) {
    static_cast<void>(run_and_count(world, 0.02));
    EXPECT_EQ(crossings(world.bodies[0], world.bodies[0]), 0);
  }
}

/// A turning paddle that sweeps a block along.
World swept_block() {
  World world;
  world.gravity.setZero();
  Obstacle paddle;
  paddle.shape = SolidBox{Vec3(0.15, 0.05, 0.01)};
  paddle.spin = Vec3(0, 3, 0);
  world.obstacles.push_back(paddle);
  world.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3(0.08, -0.03, -0.09)));
  return world;
}

TEST(CrossingGuard, MovingObstaclesPushWithoutEntering) {
  World world = swept_block();
  EXPECT_EQ(run_and_count(world, 0.3), 0);
  EXPECT_GT(linear_momentum(world.bodies[0]).norm() / world.bodies[0].masses.sum(), 0.1);
}

/// A torus of coarse bricks, whose contact surface cuts its corners.
TEST(CrossingGuard, WhatIsDrawnDoesNotEnterTheGround) {
  const SurfaceMesh mesh = test::torus_mesh(0.05, 0.03);
  const Solid solid = find_solids(mesh, "torus").solids.front();
  FilledSolid filled = fill_solid(solid, 0.02, bricks_for(Model::kCalibrated));
  World world;
  world.bodies.push_back(
      make_soft_body(mesh, solid, std::move(filled.grid), Model::kCalibrated, test_material(0.3, 2e4)));
  SoftBody& torus = world.bodies[0];
  place(torus, Eigen::AngleAxisd(1, Vec3(1, 0, 0.3).normalized()).toRotationMatrix(), Vec3(0, 0.09, 0));
  torus.velocities.col(1).setConstant(-1.5);
  world.obstacles.push_back(level_ground(0));
  double lowest = 1;
  for (int frame = 0; frame < 20; ++frame) {
    static_cast<void>(run_and_count(world, 0.005, 200));
    lowest = std::min(lowest, torus.skin_positions(torus.positions).col(1).minCoeff());
  }
  EXPECT_GT(lowest, 0);
  EXPECT_LT(lowest, 1e-3) << "it does not land";
}

/// The same bits, regardless of earlier frames, on every thread count.
TEST(CrossingGuard, AFrameDependsOnItsStartOnly) {
  for (const World& start : {crossed_edges(), swept_block()}) {
    World world = start;
    EXPECT_EQ(run_and_count(world, 0.05), 0);
    World other = world;
    EXPECT_EQ(run_and_count(other, 0.02), 0);
    World again = start;
    EXPECT_EQ(run_and_count(again, 0.07), 0);
    for (std::size_t i = 0; i < start.bodies.size(); ++i) {
      EXPECT_EQ(other.bodies[i].positions, again.bodies[i].positions);
    }
  }
}

}  // namespace
}  // namespace sprung
