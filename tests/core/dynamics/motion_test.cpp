#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/body/brick_hessian.h"
#include "core/body/forces.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/explicit/adaptive_integrator.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/error.h"
#include "tests/support/bodies.h"
#include "tests/support/error_message.h"
#include "tests/support/worlds.h"

namespace sprung {
namespace {

using test::box_body;
using test::kCorrectedModels;
using test::shake;
using test::test_material;
using test::world_of;

TEST(StableStep, IsTheFrequencyLimitOfOneBrick) {
  World world = world_of(box_body({4, 4, 4}, 0.01, Model::kTensile, 0.3));
  Body& body = world.bodies[0];
  const double omega = std::sqrt(largest_brick_stiffness(body) / (1000 * 1e-6 / 8));
  EXPECT_NEAR(stable_step(world, 1), 2 / omega, 1e-12 / omega);
  body.damping.beta = 0.125 / omega;  // damping ratio 1/16 at omega
  EXPECT_NEAR(stable_step(world, 1), 2 / omega * (std::sqrt(1 + 1.0 / 256) - 1.0 / 16), 1e-12 / omega);
}

TEST(StableStep, StaysStableAndGrowsBeyondIt) {
  for (const Model model : {Model::kCalibrated, Model::kTensile}) {
    for (const double safety : {0.99, 1.6}) {
      std::mt19937 random(2);
      World world = world_of(box_body({3, 3, 3}, 0.01, model, 0.3));
      world.bodies[0].contact.with_itself = false;
      shake(world.bodies[0], 1e-6, random);
      const double before = elastic_energy(world.bodies[0]);
      advance(world, Scheme::kSymplecticEuler, stable_step(world, safety), model == Model::kTensile ? 60 : 12, 0);
      const double after = elastic_energy(world.bodies[0]) + kinetic_energy(world.bodies[0]);
      EXPECT_EQ(after < 10 * before, safety < 1) << model_name(model) << ' ' << after / before;
    }
  }
}

TEST(Motion, FreeFallIsTheClosedForm) {
  const double dt = 1e-3;
  const long steps = 300;
  const double g = 9.81;
  for (const Scheme scheme : {Scheme::kSymplecticEuler, Scheme::kVerlet}) {
    World world = world_of(box_body({2, 2, 2}, 0.1, Model::kCalibrated, 0.3), {0, -g, 0});
    const Points start = world.bodies[0].positions;
    advance(world, scheme, dt, steps, 0);
    const auto n = double(steps);
    // Symplectic Euler's sum of an arithmetic series; Verlet is exact for a constant force.
    const double drop = scheme == Scheme::kVerlet ? g * n * n * dt * dt / 2 : g * dt * dt * n * (n + 1) / 2;
    const Points fall = start - world.bodies[0].positions;
    EXPECT_LT((fall.col(1).array() - drop).abs().maxCoeff(), 1e-12 * n);
    EXPECT_NEAR(world.bodies[0].velocities(0, 1), -g * n * dt, 1e-12 * n);
  }
}

TEST(Motion, FreeBodyKeepsItsMomentum) {
  for (const Model model : kCorrectedModels) {
    std::mt19937 random(9);
    World world = world_of(box_body({4, 2, 3}, 0.02, model, 0.4));
    Body& body = world.bodies[0];
    shake(body, 0.2, random);
    body.damping.beta = 1e-4;
    body.velocities.rowwise() = Eigen::RowVector3d(0.3, 0.1, -0.2);
    const Vec3 linear = linear_momentum(body);
    const Vec3 angular = angular_momentum(body);
    const double spread = std::sqrt(2 * elastic_energy(body) * body.masses.sum());
    advance(world, Scheme::kVerlet, stable_step(world), 2000, 0);
    EXPECT_LT((linear_momentum(body) - linear).norm(), 1e-11 * spread);
    EXPECT_LT((angular_momentum(body) - angular).norm(), 1e-11 * spread);
  }
}

/// The energy of an undamped body wavers with the step: the wavering falls with the square of it for Verlet and with
/// the step itself for symplectic Euler.
TEST(Motion, EnergyIsKeptToTheSchemesOrder) {
  const auto wavering = [](Scheme scheme, double share) {
    World world = world_of(box_body({3, 2, 2}, 0.02, Model::kCalibrated, 0.3));
    Body& body = world.bodies[0];
    for (int i = 0; i < body.node_count(); ++i) body.positions(i, 0) *= 1.05;
    const double start = elastic_energy(body);
    const double dt = share * stable_step(world, 1);
    double worst = 0;
    for (int i = 0; i < int(40 / share); ++i) {
      advance(world, scheme, dt, 1, 0);
      worst = std::max(worst, std::abs(elastic_energy(body) + kinetic_energy(body) - start) / start);
    }
    return worst;
  };
  const double verlet = wavering(Scheme::kVerlet, 0.2) / wavering(Scheme::kVerlet, 0.1);
  const double euler = wavering(Scheme::kSymplecticEuler, 0.2) / wavering(Scheme::kSymplecticEuler, 0.1);
  EXPECT_NEAR(verlet, 4, 0.6);
  EXPECT_NEAR(euler, 2, 0.4);
}

/// A bar of nu = 0 that hits a rigid wall end on leaves it after 2 L / c with its own speed, c = sqrt(E / rho)
/// (Saint-Venant's impact of an elastic bar).
TEST(Motion, ElasticBarBouncesAsInClosedForm) {
  const int n = 80;
  const double length = 0.4;
  const double h = length / n;
  const double speed = 0.02;
  World world = world_of(box_body({1, n, 1}, h, Model::kCalibrated, 0));
  world.obstacles = {level_ground(0, 0, 0)};
  Body& body = world.bodies[0];
  body.velocities.col(1).setConstant(-speed);
  const double contact_time = 2 * length / std::sqrt(body.material.young / body.material.density);
  const double dt = stable_step(world);
  const auto centre_speed = [&] { return linear_momentum(body).y() / body.masses.sum(); };
  double flipped = 0;
  double time = 0;
  while (time < 0.5 * contact_time || (centre_speed() < 0.5 * speed && time < 2 * contact_time)) {
    advance(world, Scheme::kVerlet, dt, 1, time);
    time += dt;
    if (flipped == 0 && centre_speed() >= 0) flipped = time;
  }
  EXPECT_NEAR(flipped, contact_time / 2, 0.01 * contact_time);
  advance(world, Scheme::kVerlet, dt, long(contact_time / dt), time);
  EXPECT_NEAR(centre_speed(), speed, 0.03 * speed);
  EXPECT_GT(body.positions.col(1).minCoeff(), 0);
}

/// Gravity tilted by 0.3 rad is a slope. A nearly rigid block slides down with g (sin - mu cos) or stays.
TEST(Motion, FrictionSticksBelowItsAngleAndSlidesAboveIt) {
  const double tilt = 0.3;
  const double g = 9.81;
  for (const double friction : {0.2, 0.5}) {
    Body block = make_body(make_box_grid({6, 3, 6}, 0.02), Model::kCalibrated, test_material(0.3, 3e5));
    block.damping.beta = 1e-3;
    World world = world_of(std::move(block), {g * std::sin(tilt), -g * std::cos(tilt), 0});
    world.obstacles = {level_ground(0, friction, 0)};
    const Body& body = world.bodies[0];
    const auto centre = [&] { return (body.positions.transpose() * body.masses).x() / body.masses.sum(); };
    const double dt = stable_step(world);
    const long settle = long(0.2 / dt);
    advance(world, Scheme::kSymplecticEuler, dt, settle, 0);
    const double x0 = centre();
    const double v0 = linear_momentum(body).x() / body.masses.sum();
    const long steps = long(0.5 / dt);
    advance(world, Scheme::kSymplecticEuler, dt, steps, 0);
    const double t = double(steps) * dt;
    const double a = g * (std::sin(tilt) - friction * std::cos(tilt));
    const double expected = friction < std::tan(tilt) ? v0 * t + a * t * t / 2 : 0;
    EXPECT_NEAR(centre() - x0, expected, friction < std::tan(tilt) ? 0.03 * expected : 1e-3 * 0.12) << friction;
  }
}

TEST(Motion, DroppedCubeOnItsCornerKeepsNoBrickInverted) {
  Body cube = make_body(make_box_grid({6, 6, 6}, 0.1 / 6), Model::kCalibrated, test_material(0.3, 2e4));
  const Mat3 on_corner = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitY()).toRotationMatrix();
  place(cube, on_corner, Vec3(0, 0.001, 0));
  cube.damping.beta = 2e-4;
  for (const double speed : {1.0, 6.0}) {
    World world = world_of(cube, {0, -9.81, 0});
    world.obstacles = {level_ground(0)};
    world.bodies[0].velocities.col(1).setConstant(-speed);
    AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
    for (int frame = 0; frame < 20; ++frame) {
      static_cast<void>(motion.advance_frame(
          0.02 * frame, 0.02, [](double) {}, [](const std::string&) {}));
    }
    EXPECT_EQ(inverted_bricks(world.bodies[0]), 0) << speed;
    EXPECT_GT(world.bodies[0].positions.col(1).minCoeff(), -0.002) << speed;
  }
}

/// A cube that falls flat is pushed by the ground in the same way at all four corners: it bounces without turning.
TEST(Motion, SymmetricCubeBouncesWithoutTumbling) {
  World world = world_of(box_body({2, 2, 2}, 0.05, Model::kCalibrated, 0.3), {0, -9.81, 0});
  world.obstacles = {level_ground(0, 0, 0)};
  Body& body = world.bodies[0];
  place(body, Mat3::Identity(), Vec3(0, 0.05, 0));
  const double dt = stable_step(world);
  for (int look = 0; look < 20; ++look) {
    advance(world, Scheme::kSymplecticEuler, dt, long(0.1 / dt), 0.1 * look);
    for (int node = 0; node < body.node_count(); ++node) {
      const Eigen::Vector3i& place = body.grid.lattice[node];
      const int mirror = (2 - place.x()) + 3 * place.y() + 9 * place.z();
      EXPECT_NEAR(body.positions(node, 1), body.positions(mirror, 1), 1e-9) << "t = " << 0.1 * (look + 1);
    }
  }
}

/// A body that starts a little below the ground rises, but no higher than if thrown from there.
TEST(Motion, SlightOverlapWithTheGroundIsLiftedGently) {
  const double h = 0.02;
  World world = world_of(box_body({4, 4, 4}, h, Model::kCalibrated, 0.3), {0, -9.81, 0});
  world.obstacles = {level_ground(0)};
  Body& body = world.bodies[0];
  body.damping.beta = 1e-3;
  place(body, Mat3::Identity(), Vec3(0, -0.9 * h, 0));
  const double dt = stable_step(world);
  double highest = -h;
  for (int look = 0; look < 100; ++look) {
    advance(world, Scheme::kSymplecticEuler, dt, long(0.01 / dt), 0.01 * look);
    highest = std::max(highest, body.positions.col(1).minCoeff());
  }
  EXPECT_LT(highest, h);
  EXPECT_GT(body.positions.col(1).minCoeff(), -0.01 * h);
}

/// A node with hardly any mass makes the step, which counts on lumped masses, too long: detected within the frame,
/// reported, and cured by halving it.
TEST(AdaptiveIntegrator, HalvesTheStepWhereEnergyComesFromNowhere) {
  World world = world_of(box_body({3, 2, 2}, 0.02, Model::kTensile, 0.3));
  Body& body = world.bodies[0];
  std::mt19937 random(4);
  shake(body, 0.01, random);
  body.masses[0] /= 40;
  const double before = energy_of(body, world.gravity).sum();
  std::vector<std::string> said;
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  const double frame = 200 * stable_step(world);
  static_cast<void>(motion.advance_frame(
      0, frame, [](double) {}, [&](const std::string& line) { said.push_back(line); }));
  ASSERT_FALSE(said.empty());
  EXPECT_NE(said[0].find("body 1, brick"), std::string::npos) << said[0];
  EXPECT_LT(energy_of(body, world.gravity).sum(), 1.5 * before);
}

TEST(AdaptiveIntegrator, EnergyBeyondNumbersIsNoMotion) {
  World world = world_of(box_body({2, 1, 1}, 0.02, Model::kCalibrated, 0.3));
  world.bodies[0].velocities.setConstant(1e160);  // finite, its square is not
  AdaptiveIntegrator motion(world, Scheme::kSymplecticEuler);
  EXPECT_THROW(static_cast<void>(motion.advance_frame(
                   0, 1e-3, [](double) {}, [](const std::string&) {})),
               Diverged);
}

TEST(AdaptiveIntegrator, RefusesMoreStepsThanCanBeDone) {
  World world = world_of(box_body({2, 1, 1}, 0.02, Model::kCalibrated, 0.3));
  world.obstacles.push_back(level_ground(-1));
  world.bodies[0].velocities.setConstant(1e100);
  try {
    static_cast<void>(choose_steps(world, 1));
    FAIL() << "steps that cannot be counted";
  } catch (const Diverged& error) {
    EXPECT_NE(std::string(error.what()).find("1.73e+100 m/s"), std::string::npos) << error.what();
  }
}

TEST(AdaptiveIntegrator, GivesUpWithTimeBodyAndRemedy) {
  World world = world_of(box_body({2, 1, 1}, 0.02, Model::kCalibrated, 0.3));
  world.bodies[0].velocities(3, 1) = std::nan("");
  AdaptiveIntegrator motion(world, Scheme::kVerlet);
  int said = 0;
  try {
    static_cast<void>(motion.advance_frame(
        0.25, 0.01, [](double) {}, [&](const std::string&) { ++said; }));
    FAIL() << "a velocity that is not finite went by unseen";
  } catch (const Diverged& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kDiverged);
    EXPECT_EQ(error.body(), 0);
    for (const char* part : {"body 1, brick", "0.25", "use more bricks"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(said, 4);
}

TEST(Motion, PinnedNodesStay) {
  World world = world_of(box_body({4, 1, 1}, 0.02, Model::kCalibrated, 0.3), {0, -9.81, 0});
  SoftBody& body = world.bodies[0];
  for (int i = 0; i < body.node_count(); ++i) {
    if (body.rest_positions(i, 0) < 1e-9) body.pinned.push_back({.node = i});
  }
  ASSERT_EQ(body.pinned.size(), 4U);
  const Points rest = body.positions;
  advance(world, Scheme::kVerlet, stable_step(world), 500, 0);
  for (const KinematicNode& pinned : body.pinned) EXPECT_EQ(body.positions.row(pinned.node), rest.row(pinned.node));
  EXPECT_LT(body.positions.col(1).minCoeff(), -1e-5);
}

/// A body of which hardly more than pinned nodes is below the ground stays there, and is not thrown up.
TEST(Motion, GroundPushesNothingThatIsHeld) {
  const double h = 0.02;
  World world = world_of(box_body({2, 2, 2}, h, Model::kCalibrated, 0.3), {0, -9.81, 0});
  world.obstacles = {level_ground(1e-4 * h)};
  SoftBody& body = world.bodies[0];
  Points positions = body.rest_positions;
  for (int i = 0; i < body.node_count(); ++i) {
    if (positions(i, 1) > 1e-9) continue;
    body.pinned.push_back({.node = i});
    positions(i, 1) = 1e-9 * h;  // of which the free nodes above carry a thousand-millionth
  }
  body.contact.points = embed(body.grid, positions);
  advance(world, Scheme::kVerlet, stable_step(world), 100, 0);
  EXPECT_LT((body.positions - body.rest_positions).cwiseAbs().maxCoeff(), 0.1 * h);
}

TEST(Motion, NonFiniteStateIsNamed) {
  World world = world_of(box_body({2, 1, 1}, 0.02, Model::kCalibrated, 0.3));
  world.bodies[0].positions(3, 1) = std::nan("");
  const std::string message =
      error_message(ErrorKind::kDiverged, [&] { advance(world, Scheme::kVerlet, 1e-5, 1, 0.25); });
  EXPECT_NE(message.find("body 1"), std::string::npos) << message;
  EXPECT_NE(message.find("0.25"), std::string::npos) << message;
}

}  // namespace
}  // namespace sprung
