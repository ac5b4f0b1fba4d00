#include "core/body/brick_model.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/body/brick_measures.h"
#include "core/body/forces.h"
#include "core/bricks/fill_solid.h"
#include "core/bricks/pieces.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/statics/statics.h"
#include "core/law/neo_hooke/strain_energy.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/bodies.h"
#include "tests/support/calibrated_box.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

constexpr std::array<Model, 3> kOneOfEach{Model::kCalibrated, Model::kFem, Model::kNeoHooke};

Body torus_of(Model model, double poisson) {
  const Solid solid = find_solids(test::torus_mesh(0.1, 0.04), "torus").solids.at(0);
  Material material = test::test_material(poisson);
  material.damping = 0.1;
  Body body = make_body(fill_solid(solid, 0.03).grid, model, material);
  body.stiffness_scale[3] *= 5;  // a region
  build_tiles(body);
  return body;
}

TEST(BrickModel, SumsUpToTheBody) {
  std::mt19937 random(1);
  for (const Model model : kOneOfEach) {
    Body body = torus_of(model, 0.4);
    test::shake(body, 0.1, random);
    body.velocities.setRandom();
    const BrickModel& bricks = brick_model(model);
    double energy = 0;
    Points forces = Points::Zero(body.node_count(), 3);
    for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
      const BrickVector x = at_corners(body, brick, body.positions);
      energy += bricks.energy(body, brick, x);
      const BrickVector force = bricks.damped_forces(body, brick, x, at_corners(body, brick, body.velocities));
      for (int c = 0; c < 8; ++c) forces.row(body.grid.nodes[brick][c]) += force.segment<3>(3 * c).transpose();
    }
    ForceWorkspace workspace;
    Points found;
    spring_forces(body, workspace, found);
    EXPECT_NEAR(elastic_energy(body) / energy, 1, 1e-12) << model_name(model);
    EXPECT_LT((found - forces).norm(), 1e-12 * forces.norm()) << model_name(model);
  }
}

TEST(BrickModel, HasProductsThatAreThoseOfItsMatrix) {
  std::mt19937 random(2);
  for (const Model model : kOneOfEach) {
    Body body = torus_of(model, 0.3);
    test::shake(body, 0.05, random);
    const Supports supports(body.node_count());
    const FreeDofs dofs(supports);
    const Eigen::VectorXd u = Eigen::VectorXd::Random(3 * body.node_count());
    StepTerms terms;
    terms.damping = 0.5;
    terms.damping_positions = body.rest_positions;
    ProductWorkspace workspace;
    Eigen::VectorXd product;
    Eigen::VectorXd damping;
    multiply_stiffness(body, u, workspace, product);
    multiply_damping(body, body.rest_positions, 0.5, u, workspace, damping);
    const Eigen::VectorXd expected = stiffness_matrix(body, dofs, false, terms).selfadjointView<Eigen::Lower>() * u;
    EXPECT_LT((product + damping - expected).norm(), 1e-12 * expected.norm()) << model_name(model);
  }
}

/// Tip sag over beam theory of a plate 20 x 1 x 1 bricks, t bricks thick, `low` bricks up.
double plate_sag(double thickness, double low, double poisson) {
  constexpr double kSide = 0.05;
  BrickGrid grid = make_box_grid({20, 1, 1}, kSide);
  const Vec3 from(0, 0, low);
  const Vec3 to(20, 1, low + thickness);
  const Solid plate = find_solids(test::box_mesh(kSide * from, kSide * to), "plate").solids.at(0);
  grid.fill.assign(20, thickness);
  split_pieces(plate, grid);
  grid.moments = solid_moments(grid);
  const double young = 1e6;
  const Body body = make_body(std::move(grid), Model::kNeoHooke, test::test_material(poisson, young));
  Supports supports(body.node_count());
  Points loads = Points::Zero(body.node_count(), 3);
  loads.col(2) = -1e-3 * body.masses;
  std::vector<int> tip;
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == 0) supports.fix(node);
    if (body.grid.lattice[node].x() == 20) tip.push_back(node);
  }
  const auto system = make_direct_solver();
  const Eigen::VectorXd u = solve_linear(body, supports, loads, *system);
  double sag = 0;
  for (const int node : tip) sag -= u[3 * node + 2] / double(tip.size());
  const double length = 20 * kSide;
  const double section = thickness * kSide * kSide;
  const double inertia = section * std::pow(thickness * kSide, 2) / 12;
  return sag / (1e-3 * body.material.density * section * std::pow(length, 4) / (8 * young * inertia));
}

TEST(NeoHookeBody, BendsAsThinAsItsPlateIs) {
  for (const double poisson : {0.0, 0.3}) {
    for (const double thickness : {0.2, 0.25, 0.35, 0.5, 0.67, 0.8, 1.0}) {
      for (const double share : {0.0, 0.21, 0.5, 0.83, 1.0}) {
        EXPECT_NEAR(plate_sag(thickness, share * (1 - thickness), poisson), 1, 0.01)
            << "t/h " << thickness << " at " << share << ", nu " << poisson;
      }
    }
  }
}

/// A cube of 5 kPa and 20 cm on a base that holds it; its height at rest in it, m.
double standing_height(int across, double poisson, int& newton_steps, int& inverted) {
  Body body = make_body(make_box_grid({across, across, across}, 0.2 / across), Model::kNeoHooke,
                        test::test_material(poisson, 5e3));
  Supports supports(body.node_count());
  Points loads = Points::Zero(body.node_count(), 3);
  loads.col(2) = -9.81 * body.masses;
  int top = 0;
  for (int node = 0; node < body.node_count(); ++node) {
    const Eigen::Vector3i& at = body.grid.lattice[node];
    if (at.z() == 0) supports.fix(node);
    if (at == Eigen::Vector3i(across / 2, across / 2, across)) top = node;
  }
  const auto system = make_default_solver();
  const StaticReport report = solve_static(body, supports, loads, body.rest_positions, *system);
  newton_steps = report.iterations;
  inverted = inverted_bricks(body);
  return body.positions(top, 2);
}

TEST(NeoHookeBody, StandsUnderItsOwnWeight) {
  for (const double poisson : {0.3, 0.45, 0.49}) {
    int steps = 0;
    int inverted = 0;
    const double height = standing_height(8, poisson, steps, inverted);
    EXPECT_LE(steps, 8) << poisson;
    EXPECT_EQ(inverted, 0);
    EXPECT_NEAR(height / standing_height(16, poisson, steps, inverted), 1, 0.005) << poisson;
  }
}

TEST(NeoHookeBody, KeepsItsMomentaInFreeFlight) {
  std::mt19937 random(3);
  World world;
  world.gravity.setZero();
  SoftBody body;
  static_cast<Body&>(body) = torus_of(Model::kNeoHooke, 0.4);
  test::shake(body, 0.1, random);
  body.velocities.setRandom();
  world.bodies.push_back(std::move(body));
  const Vec3 linear = linear_momentum(world.bodies[0]);
  const Vec3 angular = angular_momentum(world.bodies[0]);
  const double energy = elastic_energy(world.bodies[0]) + kinetic_energy(world.bodies[0]);
  test::advance_by_stable_steps(world, Scheme::kSymplecticEuler, 0.05);
  EXPECT_LT((linear_momentum(world.bodies[0]) - linear).norm(), 1e-10 * linear.norm());
  EXPECT_LT((angular_momentum(world.bodies[0]) - angular).norm(), 1e-10 * angular.norm());
  EXPECT_LT(elastic_energy(world.bodies[0]) + kinetic_energy(world.bodies[0]), energy);
}

TEST(NeoHookeBody, MeasuresStressOfItsLaw) {
  Body body = torus_of(Model::kNeoHooke, 0.4);
  body.stiffness_scale[3] /= 5;
  Mat3 gradient;
  gradient << 1.2, 0.1, 0, -0.1, 0.9, 0.2, 0, 0.1, 1.1;
  const Points positions = body.rest_positions * gradient.transpose();
  const Mat3 cauchy = NeoHooke(body.material).stress(gradient) * gradient.transpose() / gradient.determinant();
  const Eigen::VectorXd stress = measure_bricks(body, BrickMeasure::kStress, positions);
  EXPECT_LT((stress.array() / von_mises(cauchy) - 1).abs().maxCoeff(), 1e-10);
  const Eigen::VectorXd volume = measure_bricks(body, BrickMeasure::kVolume, positions);
  EXPECT_LT((volume.array() / gradient.determinant() - 1).abs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace sprung
