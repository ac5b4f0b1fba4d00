#include "core/world/loads.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/body/body.h"
#include "core/body/forces.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/world/load_forces.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

World weightless(SoftBody body) {
  World world;
  world.gravity.setZero();
  world.bodies.push_back(std::move(body));
  return world;
}

std::shared_ptr<const SkinPart> whole_skin(const SoftBody& body) {
  SkinPart part;
  for (int row = 0; row < body.contact.triangles.rows(); ++row) part.triangles.push_back(row);
  part.weights = Points::Constant(body.contact.triangles.rows(), 3, 1.0 / 3);
  return std::make_shared<const SkinPart>(std::move(part));
}

/// A force on a free body accelerates it by F / m, whatever it does inside.
TEST(Loads, ForceAcceleratesAFreeBody) {
  World world = weightless(touching_box({4, 2, 2}, 0.01, test_material(0.3, 2e4), Vec3::Zero()));
  Body& body = world.bodies[0];
  Points& forces = world.bodies[0].loads.forces;
  forces = Points::Zero(body.node_count(), 3);
  forces.row(3) = Eigen::RowVector3d(0.002, -0.001, 0.0005);
  const double dt = stable_step(world);
  advance(world, Scheme::kSymplecticEuler, dt, 200, 0);
  const Vec3 expected = 200 * dt * Vec3(0.002, -0.001, 0.0005);
  EXPECT_LT((linear_momentum(body) - expected).norm(), 1e-10 * expected.norm());
}

/// Pressure on a closed skin has no resultant, and does the work p dV if the body swells.
TEST(Loads, PressureOnAClosedSkinDoesTheWorkOfItsVolume) {
  World world = weightless(touching_box({3, 2, 2}, 0.01, test_material(0.3, 2e4), Vec3::Zero()));
  SoftBody& body = world.bodies[0];
  body.loads.pressures.push_back({.part = whole_skin(body), .pressure = 700});
  const Points forces = LoadForces(body, world).forces();
  EXPECT_LT(forces.colwise().sum().norm(), 1e-12);
  const double strain = 1e-3;
  const Points displacements = strain * body.positions;  // swells alike in all directions
  const double work = forces.cwiseProduct(displacements).sum();
  EXPECT_NEAR(work, -700 * 3 * strain * body.grid.volume(), 1e-12);
}

/// Pressed from all sides a body loses the share p / K of its volume, K = E / (3 (1 - 2 nu)).
TEST(Loads, PressureShrinksABodyByItsBulkModulus) {
  World world = weightless(touching_box({4, 4, 4}, 0.01, test_material(0.3, 2e4), Vec3::Zero()));
  SoftBody& body = world.bodies[0];
  const double pressure = 100;
  body.loads.pressures.push_back({.part = whole_skin(body), .pressure = pressure});
  body.damping = {.alpha = 30, .beta = 0};
  advance(world, Scheme::kSymplecticEuler, stable_step(world), 6000, 0);
  const double bulk = 2e4 / (3 * (1 - 0.6));
  double volume = 0;
  for (const auto& nodes : body.grid.nodes) {
    volume += mean_axes_of(columns_of(nodes, body.positions)).determinant();
  }
  EXPECT_NEAR(1 - volume / std::pow(0.04, 3), pressure / bulk, 0.03 * pressure / bulk);
}

/// A plate normal to the wind feels density drag area v^2 / 2; one along it only the wind on its edge.
TEST(Loads, WindPressesOnWhatFacesIt) {
  World world = weightless(touching_box({1, 6, 5}, 0.01, test_material(0.3, 2e4), Vec3::Zero()));
  world.wind = {.velocity = {8, 0, 0}, .density = 1.2, .drag = 1.1};
  SoftBody& body = world.bodies[0];
  const Vec3 at_rest = LoadForces(body, world).forces().colwise().sum();
  EXPECT_LT((at_rest - Vec3(0.5 * 1.2 * 1.1 * 64 * 0.06 * 0.05, 0, 0)).norm(), 1e-12);
  body.velocities.col(0).setConstant(8);
  EXPECT_LT(LoadForces(body, world).forces().norm(), 1e-12);
}

/// Nothing resists: every brick takes the muscle's shape, and the body as a whole does not move. Across the edges
/// diagonals carry more of it, whose directions turn: there it is a little off.
TEST(Loads, FreeMuscleContractsAndKeepsItsVolume) {
  for (const auto& [direction, accuracy] : {std::pair(Vec3(1, 0, 0), 1e-6), std::pair(Vec3(0.6, 0.8, 0), 1e-6)}) {
    World world = weightless(touching_box({5, 2, 2}, 0.01, test_material(0.4, 2e4), Vec3::Zero()));
    SoftBody& body = world.bodies[0];
    Muscle muscle{.bricks = {}, .direction = direction, .contraction = 0.2};
    for (int brick = 0; brick < body.grid.brick_count(); ++brick) muscle.bricks.push_back(brick);
    body.loads.muscles = {muscle};
    body.damping = {.alpha = 40, .beta = 0};
    const Vec3 middle = body.masses.transpose() * body.positions;
    advance(world, Scheme::kSymplecticEuler, stable_step(world), 6000, 0);
    EXPECT_LT(linear_momentum(body).norm(), 1e-12);
    EXPECT_LT((Vec3(body.masses.transpose() * body.positions) - middle).norm(), 1e-12);
    const Mat3 deformed = mean_axes_of(columns_of(body.grid.nodes[8], body.positions)) / 0.01;
    EXPECT_NEAR((deformed * direction).norm(), 0.8, accuracy) << direction.transpose();
    EXPECT_NEAR(deformed.determinant(), 1, accuracy) << direction.transpose();
  }
}

}  // namespace
}  // namespace sprung
