#include "core/simulation/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "app/scene/scene_file.h"
#include "core/bricks/voxelize.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

/// Built-in bodies, how they start and how they are repeated.
namespace sprung {
namespace {

constexpr double kPi = std::numbers::pi;

Simulation produce(const std::string& body) {
  const Observer silent;
  return prepare_simulation(parse_scene("[[body]]\n" + body, "/scene.toml"), silent);
}

void expect_volume(const SurfaceMesh& mesh, double volume) {
  const Solids found = find_solids(mesh, "shape");
  ASSERT_EQ(found.solids.size(), 1U);
  for (const Repair& repair : found.repairs) EXPECT_TRUE(repair.harmless) << repair.text;
  EXPECT_NEAR(enclosed_volume(found.solids[0]) / volume, 1, 5e-3);
  EXPECT_LE(enclosed_volume(found.solids[0]), volume);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Vec3 a = mesh.positions.row(mesh.triangles(t, 0));
    const Vec3 b = mesh.positions.row(mesh.triangles(t, 1));
    const Vec3 c = mesh.positions.row(mesh.triangles(t, 2));
    const Vec3 outward = (b - a).cross(c - a).normalized();
    for (int i = 0; i < 3; ++i) EXPECT_GT(outward.dot(mesh.normals.row(mesh.triangles(t, i)).cast<double>()), 0.9);
  }
}

TEST(Shapes, AreClosedOutwardAndAsLargeAsTheyShould) {
  expect_volume(mesh_of(SphereShape{.radius = 0.3}), 4.0 / 3 * kPi * 0.027);
  expect_volume(mesh_of(CylinderShape{.radius = 0.1, .height = 0.5}), kPi * 0.01 * 0.5);
  expect_volume(mesh_of(TorusShape{.radius = 0.4, .tube = 0.1}), 2 * kPi * kPi * 0.4 * 0.01);
}

TEST(Shapes, BecomeBodies) {
  const Simulation ball = produce("sphere = { radius = \"10 cm\" }\nbricks = 12\nmaterial = \"gelatin\"\n");
  const Body& body = ball.world.bodies.at(0);
  const double mass = built_in_materials()->find("gelatin").density * 4.0 / 3 * kPi * 1e-3;
  EXPECT_NEAR(body.masses.sum() / mass, 1, 0.01);
  const Simulation ring = produce("torus = { radius = 0.4, tube = 0.1 }\nbricks = 20\n");
  EXPECT_NEAR(ring.world.bodies.at(0).grid.brick_size, 0.05, 1e-12);
  EXPECT_EQ(produce("cylinder = { radius = 0.1, height = 1 }\nbricks = \"auto\"\n").world.bodies.size(), 1U);
}

TEST(Shapes, WrongOnesAreRefused) {
  const auto mistake = [](const std::string& body) { return error_message([&] { static_cast<void>(produce(body)); }); };
  EXPECT_NE(mistake("torus = { radius = 0.1, tube = 0.1 }").find("the tube must be thinner"), std::string::npos);
  EXPECT_NE(mistake("sphere = { radius = 1 }\ncylinder = { radius = 1, height = 1 }")
                .find("give sphere or cylinder, not both"),
            std::string::npos);
  EXPECT_NE(
      mistake("sphere = { radius = 1 }\nsize = 2").find("/scene.toml:3:8: body: 'size' is for a body with 'mesh'"),
      std::string::npos);
  EXPECT_NE(mistake("sphere = { radius = 1 }\ncopies = { count = [2, 0, 1], spacing = [1, 1, 1] }")
                .find("body.copies.count[1]: 0 is out of range"),
            std::string::npos);
}

TEST(Start, SpinTurnsABodyAboutItsMiddle) {
  const Simulation simulation = produce(
      "box = [0.1, 0.1, 0.1]\nbricks = 2\nposition = [3, 0, 0]\nvelocity = [0, 1, 0]\nspin = [0, 0, \"1 rad/s\"]\n");
  const Body& body = simulation.world.bodies.at(0);
  for (int node = 0; node < body.node_count(); ++node) {
    const Vec3 arm = body.positions.row(node).transpose() - Vec3(3, 0.05, 0);
    EXPECT_LT((body.velocities.row(node).transpose() - Vec3(-arm.y(), 1 + arm.x(), 0)).norm(), 1e-12);
  }
}

std::vector<Vec3> middles(const Simulation& simulation) {
  std::vector<Vec3> positions;
  for (const SoftBody& body : simulation.world.bodies) positions.emplace_back(body.positions.colwise().mean());
  return positions;
}

TEST(Copies, StandInRows) {
  const std::vector<Vec3> positions =
      middles(produce("box = [0.1, 0.1, 0.1]\nbricks = 1\nposition = [1, 0, 0]\ncopies = { count = [2, 3, 1], spacing "
                      "= [0.5, 0.2, 0] }\n"
                      "[[body.pin]]\nbox = { min = [0, 0, 0], max = [1, 0.1, 1] }\n"));
  ASSERT_EQ(positions.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 expected(1 + 0.5 * double(i % 2), 0.05 + 0.2 * double(i / 2), 0);
    EXPECT_LT((positions[i] - expected).norm(), 1e-12);
  }
}

TEST(Copies, AreScatteredByTheirSeed) {
  const auto scattered = [](const std::string& seed) {
    return middles(
        produce("box = [0.1, 0.1, 0.1]\nbricks = 1\ncopies = { count = [5, 1, 4], spacing = [1, 1, 1], scatter "
                "= 0.2, turn = 180, seed = " +
                seed + " }\n"));
  };
  const std::vector<Vec3> positions = scattered("3");
  EXPECT_EQ(positions, scattered("3"));
  EXPECT_NE(positions, scattered("4"));
  double furthest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double shift = positions[i].x() - double(i % 5);
    EXPECT_LE(std::abs(shift), 0.2);
    furthest = std::max(furthest, std::abs(shift));
  }
  EXPECT_GT(furthest, 0.1);
}

}  // namespace
}  // namespace sprung
