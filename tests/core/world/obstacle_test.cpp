#include "core/world/obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/body/forces.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/simulation/shapes.h"
#include "tests/support/penetration.h"
#include "tests/support/sanitized.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

std::vector<Shape> all_shapes() {
  const SurfaceMesh box = surface_of(make_box_grid({2, 3, 4}, 0.1));
  return {SolidHalfSpace{},        SolidBox{{0.1, 0.2, 0.3}},
          SolidBall{0.3},          SolidCapsule{0.1, 0.2},
          SolidCylinder{0.2, 0.1}, MeshSolid{std::make_shared<MeshDistance>(box.positions, box.triangles)}};
}

/// The normal is the gradient, of length one; going back along it by the distance ends on the surface.
TEST(Obstacle, GapIsASignedDistance) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> range(-0.6, 0.6);
  const Pose pose{Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix(), {0.1, 0.2, -0.1}};
  for (const Shape& shape : all_shapes()) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 place(range(random), range(random), range(random));
      const Gap gap = signed_distance(shape, pose, place);
      EXPECT_NEAR(gap.normal.norm(), 1, 1e-12) << shape.index();
      const double h = 1e-7;
      const Gap ahead = signed_distance(shape, pose, place + h * gap.normal);
      const bool is_at_ridge = gap.distance < 0 && ahead.normal.dot(gap.normal) < 0.999;
      if (!is_at_ridge) {
        EXPECT_NEAR(ahead.distance - gap.distance, h, 1e-2 * h) << shape.index();
      }
      EXPECT_NEAR(signed_distance(shape, pose, place - gap.distance * gap.normal).distance, 0, 1e-9) << shape.index();
    }
  }
}

TEST(Obstacle, MeshBoxIsTheBox) {
  const SurfaceMesh mesh = surface_of(make_box_grid({2, 4, 6}, 0.1));
  const Shape as_mesh = MeshSolid{std::make_shared<MeshDistance>(mesh.positions, mesh.triangles)};
  const Shape as_box = SolidBox{{0.1, 0.2, 0.3}};
  const Vec3 middle(0.1, 0.2, 0.3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range(-0.2, 0.8);
  for (int i = 0; i < 300; ++i) {
    const Vec3 place(range(random), range(random), range(random));
    EXPECT_NEAR(signed_distance(as_mesh, {}, place).distance,
                signed_distance(as_box, {Mat3::Identity(), middle}, place).distance, 1e-12);
  }
}

Vec3 centre_of(const Body& body) { return body.positions.transpose() * body.masses / body.masses.sum(); }

void run(World& world, double duration, double fps) {
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  const long frames = std::lround(duration * fps);
  for (long frame = 0; frame < frames; ++frame) {
    static_cast<void>(motion.advance_frame(
        double(frame) / fps, 1 / fps, [](double) {}, [](const std::string& what) { FAIL() << what; }));
  }
}

constexpr double kSeconds = test::kSanitized ? 1 : 10;

/// A block on a tilted plane: below the friction angle it stays for ten seconds, above it slides as a rigid one does.
TEST(Obstacle, BlockOnASlopeStaysOrSlides) {
  const double tilt = 0.3;
  const Mat3 slope = Eigen::AngleAxisd(-tilt, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 down(std::cos(tilt), -std::sin(tilt), 0);
  for (const double friction : {0.2, 0.5}) {
    World world;
    world.obstacles = {level_ground(0, friction)};
    world.obstacles[0].pose.rotation = slope;
    SoftBody block = touching_box({6, 3, 6}, 0.02, test_material(0.3, 3e5), Vec3::Zero());
    place(block, slope, Vec3::Zero());
    block.damping.beta = 1e-3;
    world.bodies.push_back(std::move(block));
    const Body& body = world.bodies[0];
    run(world, 0.2, 20);
    const double start = centre_of(body).dot(down);
    const double speed = linear_momentum(body).dot(down) / body.masses.sum();
    const bool slides = friction < std::tan(tilt);
    const double time = slides ? 0.5 : kSeconds;
    run(world, time, 20);
    const double acceleration = 9.81 * (std::sin(tilt) - friction * std::cos(tilt));
    const double way = centre_of(body).dot(down) - start;
    if (slides) {
      const double expected = speed * time + acceleration * time * time / 2;
      EXPECT_NEAR(way, expected, 0.03 * expected);
    } else {
      EXPECT_LT(std::abs(way), 1e-3 * 0.12);
    }
  }
}

/// A plate comes down on a cube, compresses it to two thirds, and rises again: the cube then recovers its shape.
TEST(Obstacle, SquashedCubeComesBack) {
  World world;
  world.gravity.setZero();
  world.obstacles = {level_ground(0), {}};
  world.bodies.push_back(touching_box({4, 4, 4}, 0.02, test_material(0.3), Vec3::Zero()));
  Body& body = world.bodies[0];
  body.damping.beta = 2e-3;
  Obstacle& plate = world.obstacles[1];
  plate.shape = SolidBox{{0.1, 0.01, 0.1}};
  plate.pose.translation = Vec3(0.04, 0.0905, 0.04);
  plate.velocity.y() = -0.1;
  run(world, 0.27, 100);
  EXPECT_NEAR(body.positions.col(1).maxCoeff(), 0.0535 - 0.03 * 0.02, 0.0005);  // contact leaves 0.03 bricks
  EXPECT_LT(test::deepest_contact_point(world), 0.0005);
  plate.velocity.y() = 0.5;
  run(world, 0.01, 100);
  EXPECT_LT(test::deepest_contact_point(world), 0.0005);
  run(world, 0.09, 100);
  plate.velocity.setZero();
  run(world, 1, 100);
  const Vec3 size = body.positions.colwise().maxCoeff() - body.positions.colwise().minCoeff();
  EXPECT_LT((size - Vec3::Constant(0.08)).cwiseAbs().maxCoeff(), 0.01 * 0.08);
  EXPECT_EQ(inverted_bricks(body), 0);
}

/// A turntable carries what lies on it.
TEST(Obstacle, TurningCylinderCarriesABodyAround) {
  World world;
  world.obstacles = {{}};
  Obstacle& table = world.obstacles[0];
  table.shape = SolidCylinder{0.3, 0.05};
  table.pose.translation.y() = -0.05;
  table.friction = 0.8;
  world.bodies.push_back(touching_box({3, 2, 3}, 0.02, test_material(0.3, 5e4), Vec3(0.1, 0, -0.03)));
  Body& body = world.bodies[0];
  body.damping.beta = 2e-3;
  run(world, 0.2, 50);
  const Vec3 start = centre_of(body);
  table.spin.y() = 1;
  run(world, 1.5, 50);
  const Vec3 end = centre_of(body);
  const double flipped = std::atan2(-end.z(), end.x()) - std::atan2(-start.z(), start.x());
  EXPECT_NEAR(flipped, 1.5, 0.05);
}

/// Soft and at rest it takes long steps; in a few of them it falls through most of a brick. Its landing is detected.
TEST(Obstacle, WhatBeginsToFallIsFoundInTime) {
  const double h = 0.0266;
  Material soft = test_material(0.4, 1800);
  soft.density = 800;
  World world;
  world.obstacles = {level_ground(0)};
  world.bodies.push_back(touching_box({4, 4, 5}, h, soft, Vec3(0, 0.4 * h, 0)));
  run(world, 0.075, 1 / 0.075);
  EXPECT_LT(test::deepest_contact_point(world), 0.01 * h);
}

/// Two points near one corner of a brick press equally: if held only in turns, both would sink in.
TEST(Obstacle, PointsThatShareACornerAreBothHeld) {
  const double h = 0.8;
  World world;
  world.obstacles = {level_ground(0)};
  world.bodies.push_back(touching_box({1, 2, 1}, h, test_material(0, 1.3e5), Vec3::Zero()));
  SoftBody& body = world.bodies[0];
  body.damping.beta = 5e-3;
  body.velocities.col(1).setConstant(-4);
  Points feet(4, 3);
  feet << 0.05, 0, 0.45, 0.45, 0, 0.05, 0.95, 0, 0.55, 0.55, 0, 0.95;
  body.contact.points = embed(body.grid, h * feet);
  body.contact.triangles.resize(0, 3);
  for (int tenth = 1; tenth <= 4; ++tenth) {
    run(world, 0.1, 10);
    EXPECT_LT(test::deepest_contact_point(world), 0.04 * h) << tenth;
  }
}

/// At the highest permitted speed nothing passes through a plate a tenth of a brick thick.
TEST(Obstacle, FastBodyDoesNotTunnel) {
  World world;
  world.gravity.setZero();
  world.obstacles = {{}};
  world.obstacles[0].shape = SolidBox{{1, 0.001, 1}};
  world.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3, 1e5), Vec3(0, 0.1, 0)));
  world.bodies[0].velocities.col(1).setConstant(-20);
  run(world, 0.05, 100);
  EXPECT_GT(world.bodies[0].positions.col(1).minCoeff(), -0.001);
}

}  // namespace
}  // namespace sprung
