#include <gtest/gtest.h>

#include <algorithm>

#include "core/bricks/pieces.h"
#include "core/bricks/slivers.h"
#include "core/bricks/voxelize.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/dynamics/implicit/implicit_motion.h"
#include "core/dynamics/statics/statics.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/bodies.h"
#include "tests/support/comb.h"

/// Two fingers a twentieth of a brick apart, on a back that is clamped at its foot.
namespace sprung {
namespace {

constexpr double kGap = 0.05;

class TwoFingers : public ::testing::Test {
 protected:
  static Body make(bool is_divided) {
    const Solid solid = find_solids(test::comb_mesh({{0, 2.4}, {2.4 + kGap, 4.7}}, 2, 6, 1.7), "fingers").solids.at(0);
    BrickGrid grid = voxelize(solid, 1);
    if (is_divided) static_cast<void>(split_pieces(solid, grid));
    absorb_slivers(grid);
    return make_body(std::move(grid), Model::kCalibrated, test::test_material(0.3, 1e6));
  }

  /// The nodes at the left side of the left finger's end, and those at the right side of the right one's.
  static std::vector<int> end_nodes(const Body& body, bool left) {
    std::vector<int> nodes;
    for (int node = 0; node < body.node_count(); ++node) {
      const Eigen::Vector3i& place = body.grid.lattice[node];
      if (place.y() == 8 && place.x() == (left ? 0 : 5)) nodes.push_back(node);
    }
    return nodes;
  }

  static std::vector<int> foot_nodes(const Body& body) {
    std::vector<int> nodes;
    for (int node = 0; node < body.node_count(); ++node) {
      if (body.grid.lattice[node].y() == 0) nodes.push_back(node);
    }
    return nodes;
  }

  static double mean_x(const Points& moved, const std::vector<int>& nodes) {
    double sum = 0;
    for (const int node : nodes) sum += moved(node, 0);
    return sum / double(nodes.size());
  }

  /// How far the right finger's end moves along, over the displacement of the left one's.
  static double share(const Body& body, const Points& moved) {
    return mean_x(moved, end_nodes(body, false)) / mean_x(moved, end_nodes(body, true));
  }

  /// Under a pull at the left finger's end.
  static double share_under_pull(const Body& body, LinearSolver& system) {
    Supports supports(body.node_count());
    for (const int node : foot_nodes(body)) supports.fix(node);
    Points loads = Points::Zero(body.node_count(), 3);
    for (const int node : end_nodes(body, true)) loads(node, 0) = -1;
    const Eigen::VectorXd u = solve_linear(body, supports, loads, system);
    return share(body, Eigen::Map<const Points>(u.data(), body.node_count(), 3));
  }

  static World world_of_pulled() {
    World world;
    SoftBody body(make(true));
    for (const int node : foot_nodes(body)) body.pinned.push_back({.node = node});
    for (const int node : end_nodes(body, true)) {
      body.pinned.push_back({.node = node, .velocity = Vec3(-1, 0, 0)});
    }
    body.damping.alpha = 5;
    world.bodies.push_back(std::move(body));
    world.gravity.setZero();
    return world;
  }

  static void expect_only_one_moved(const World& world) {
    const Body& body = world.bodies[0];
    const Points moved = body.positions - body.rest_positions;
    EXPECT_LT(mean_x(moved, end_nodes(body, true)), -0.4);
    EXPECT_LT(std::abs(share(body, moved)), 0.1);
  }
};

TEST_F(TwoFingers, OneIsPulledTheOtherStays) {
  const auto direct = make_direct_solver();
  EXPECT_LT(std::abs(share_under_pull(make(true), *direct)), 0.1);
  EXPECT_GT(share_under_pull(make(false), *direct), 0.5) << "glued by the bricks they share";
}

TEST_F(TwoFingers, MultigridKeepsThemApart) {
  const auto multigrid = make_multigrid_solver();
  const auto direct = make_direct_solver();
  const Body body = make(true);
  EXPECT_NEAR(share_under_pull(body, *multigrid), share_under_pull(body, *direct), 1e-6);
  EXPECT_EQ(multigrid->report().fallbacks, 0);
  EXPECT_LT(multigrid->report().most, 40);
}

TEST_F(TwoFingers, InMotionByExplicitSteps) {
  World world = world_of_pulled();
  const double dt = stable_step(world);
  advance(world, Scheme::kSymplecticEuler, dt, long(0.5 / dt), 0);
  expect_only_one_moved(world);
}

TEST_F(TwoFingers, InMotionByImplicitSteps) {
  World world = world_of_pulled();
  ImplicitMotion(world, {.scheme = ImplicitScheme::kBdf2}).advance(0.02, 25, 0);
  expect_only_one_moved(world);
}

}  // namespace
}  // namespace sprung
