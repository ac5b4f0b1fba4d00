#include "core/body/brick_model.h"

#include <gtest/gtest.h>

#include <random>

#include "core/body/brick_measures.h"
#include "core/body/forces.h"
#include "core/bricks/fill_solid.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/law/solid/strain_energy.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/bodies.h"
#include "tests/support/calibrated_box.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

constexpr std::array<Model, 3> kOneOfEach{Model::kTensile, Model::kFem, Model::kCalibrated};

Body torus_of(Model model, double poisson) {
  const Solid solid = find_solids(test::torus_mesh(0.1, 0.04), "torus").solids.at(0);
  Material material = test::test_material(poisson);
  material.damping = 0.1;
  Body body = make_body(fill_solid(solid, 0.03, bricks_for(model)).grid, model, material);
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

TEST(NeoHookeBody, KeepsItsMomentaInFreeFlight) {
  std::mt19937 random(3);
  World world;
  world.gravity.setZero();
  SoftBody body;
  static_cast<Body&>(body) = torus_of(Model::kCalibrated, 0.4);
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
  Body body = torus_of(Model::kCalibrated, 0.4);
  body.stiffness_scale[3] /= 5;
  Mat3 gradient;
  gradient << 1.2, 0.1, 0, -0.1, 0.9, 0.2, 0, 0.1, 1.1;
  const Points positions = body.rest_positions * gradient.transpose();
  const Mat3 cauchy = StrainEnergy(body.material).stress(gradient) * gradient.transpose() / gradient.determinant();
  const Eigen::VectorXd stress = measure_bricks(body, BrickMeasure::kStress, positions);
  EXPECT_LT((stress.array() / von_mises(cauchy) - 1).abs().maxCoeff(), 1e-10);
  const Eigen::VectorXd volume = measure_bricks(body, BrickMeasure::kVolume, positions);
  EXPECT_LT((volume.array() / gradient.determinant() - 1).abs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace sprung
