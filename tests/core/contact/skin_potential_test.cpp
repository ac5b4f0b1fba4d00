#include "core/contact/skin_potential.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "core/contact/glue.h"
#include "core/dynamics/implicit/coupling.h"
#include "tests/support/touching.h"

namespace sprung {
namespace {

using test::test_material;
using test::touching_box;

/// Two cubes, one of them a little inside the other, turned, and glued at another side for good measure.
class SkinPotentialTest : public ::testing::Test {
 protected:
  SkinPotentialTest() {
    world_.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3), Vec3::Zero()));
    world_.bodies.push_back(touching_box({3, 3, 3}, 0.02, test_material(0.3, 3e4), Vec3(0.0601, 0, 0)));
    glue_ = glue_between(world_, 0, 1, 0.001);
    glue_.resize(3);
    for (SoftBody& body : world_.bodies) group_.push_back(&body);
    std::mt19937 random(7);
    for (SoftBody& body : world_.bodies) test::shake(body, 0.05, random);
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t points = contact_surface_of(world_.bodies[i]).points.size();
      pushed_in_[i].setConstant(points, 1);  // no tolerated initial overlap
    }
    potential_.emplace(world_, group_, glue_, SkinPotential::Step{.dt = 0.01, .slip = 1e-5},
                       std::vector{&pushed_in_[0], &pushed_in_[1]});
    for (SoftBody& body : world_.bodies) test::shake(body, 0.05, random);
    potential_->refresh();
    potential_->update_friction();
  }

  double evaluate() {
    forces_.clear();
    std::vector<Points*> all;
    for (const SoftBody& body : world_.bodies) forces_.push_back(Points::Zero(body.node_count(), 3));
    for (Points& forces : forces_) all.push_back(&forces);
    return potential_->add_forces(all);
  }

  World world_;
  std::vector<GluedPoint> glue_;
  Group group_;
  std::array<Eigen::VectorXd, 2> pushed_in_;
  std::optional<SkinPotential> potential_;
  std::vector<Points> forces_;
};

TEST_F(SkinPotentialTest, ForceIsTheSlopeOfTheEnergy) {
  evaluate();
  const std::vector<Points> forces = forces_;
  EXPECT_GT(potential_->largest_normal_force(), 0);
  double largest = 0;
  for (const Points& all : forces) largest = std::max(largest, all.cwiseAbs().maxCoeff());
  const double by = 1e-9;
  for (std::size_t body = 0; body < 2; ++body) {
    Points& positions = world_.bodies[body].positions;
    for (Eigen::Index i = 0; i < positions.size(); ++i) {
      const double place = positions.data()[i];
      positions.data()[i] = place + by;
      const double above = evaluate();
      positions.data()[i] = place - by;
      const double below = evaluate();
      positions.data()[i] = place;
      EXPECT_NEAR(forces[body].data()[i], -(above - below) / (2 * by), 1e-3 * largest);
    }
  }
}

TEST_F(SkinPotentialTest, ForcesAddUpToNothing) {
  evaluate();
  Vec3 sum = Vec3::Zero();
  for (const Points& forces : forces_) sum += forces.colwise().sum().transpose();
  EXPECT_GT(forces_[0].norm(), 1e-3);
  EXPECT_LT(sum.norm(), 1e-12);
}

/// Within one body, the couplings are bounded by the parts that represent them.
TEST_F(SkinPotentialTest, OwnPartsBoundTheCouplings) {
  const std::vector<Coupling> couplings = potential_->couplings();
  ASSERT_GT(couplings.size(), 3U);
  const auto parts = own_parts(couplings, 2);
  std::mt19937 random(11);
  std::normal_distribution<double> distance;
  for (std::size_t body = 0; body < 2; ++body) {
    const Body& moving = world_.bodies[body];
    for (int trial = 0; trial < 20; ++trial) {
      Points moves(moving.node_count(), 3);
      for (double& move : moves.reshaped()) move = distance(random);
      if (trial == 0) moves.rowwise() = Eigen::RowVector3d(1, 2, 3);  // as a whole
      double coupled = 0;
      for (const Coupling& coupling : couplings) {
        Vec3 moved = Vec3::Zero();
        for (const CoupledCorners& corners : coupling.corners) {
          if (corners.body == body) moved += carried(moving, corners.brick, corners.weights, moves);
        }
        coupled += moved.dot(coupling.stiffness * moved);
      }
      double bound = 0;
      for (const PointStiffness& part : parts[body]) {
        const Vec3 moved = carried(moving, part.brick, part.weights, moves);
        bound += moved.dot(part.stiffness * moved);
      }
      EXPECT_LE(coupled, bound * (1 + 1e-9)) << trial;
      if (trial > 0) continue;
      EXPECT_NEAR(coupled, bound, 0.05 * bound);  // corners just outside a triangle count twice
    }
  }
}

}  // namespace
}  // namespace sprung
