// What a brick's constants can and cannot correct: the figures of core/law/brick_law.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "core/bricks/brick_topology.h"
#include "core/dynamics/statics/statics.h"
#include "core/law/hexahedron.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

using CornerRow = Eigen::Matrix<double, 1, 24>;

/// How much of u_axis = f there is in a brick's corner displacements, f the product of the coordinates (-1 or 1 at a
/// corner) whose bits are set in `product`.
CornerRow share_of_mode(int axis, int product) {
  CornerRow row = CornerRow::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    double value = 0.125;
    for (int k = 0; k < 3; ++k) {
      if ((product >> k & 1) != 0 && !on_high_side(corner, k)) value = -value;
    }
    row[3 * corner + axis] = value;
  }
  return row;
}

constexpr int kXyz = 7;

/// The same brick with the xyz modes of the trilinear hexahedron: no coupling with shear, 11/12 of their stiffness.
BrickMatrix without_corner_coupling(const BrickMatrix& stiffness) {
  BrickMatrix changed = stiffness;
  for (int axis = 0; axis < 3; ++axis) {
    const int j = (axis + 1) % 3;
    const int k = (axis + 2) % 3;
    const CornerRow xyz = share_of_mode(axis, kXyz);
    const CornerRow shear = share_of_mode(j, 1 << k) + share_of_mode(k, 1 << j);
    const double own = 64 * xyz * stiffness * xyz.transpose();
    const double coupling = 32 * xyz * stiffness * shear.transpose();
    changed -= own / 12 * xyz.transpose() * xyz;
    changed -= coupling * (xyz.transpose() * shear + shear.transpose() * xyz);
  }
  return changed;
}

/// The same brick with its twists coupled so that a bar of one brick has Saint-Venant's torsion constant.
/// t_i: mean of the stretches of the four diagonals of the faces normal to i, signed + on the high face's rising and
/// the low face's falling one. Energy 4 (1 - 0.843462) face (t_x t_y + t_y t_z + t_z t_x).
BrickMatrix with_twist_coupling(const BrickMatrix& stiffness, double face) {
  std::array<CornerRow, 3> twist;
  for (std::size_t i = 0; i < 3; ++i) {
    twist[i].setZero();
    for (std::size_t side = 0; side < 4; ++side) {
      const CornerPair pair = kFaceDiagonals[4 * i + side];
      const double sign = side == 0 || side == 3 ? -0.25 : 0.25;
      for (int axis = 0; axis < 3; ++axis) {
        const int difference = (pair.to >> axis & 1) - (pair.from >> axis & 1);
        twist[i][3 * pair.to + axis] += sign * difference / std::numbers::sqrt2;
        twist[i][3 * pair.from + axis] -= sign * difference / std::numbers::sqrt2;
      }
    }
  }
  BrickMatrix changed = stiffness;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i != j) changed += 4 * (1 - 0.843462) * face * twist[i].transpose() * twist[j];
    }
  }
  return changed;
}

const Material kMaterial{.name = "test", .young = 1000, .poisson = 0.3, .density = 1, .damping = 0, .source = ""};

Body body_of(BrickGrid grid, bool corner_coupling) {
  Body body = make_body(std::move(grid), Model::kFem, kMaterial);
  const BrickMatrix stiffness = test::rest_stiffness(Model::kSprings, kMaterial, body.grid.brick_size);
  body.small_strain_stiffness = corner_coupling ? stiffness : without_corner_coupling(stiffness);
  return body;
}

/// Torque of a bar 4 : 1 : 1 whose ends turn in their planes by a small angle, over that of converged finite elements
/// (assets/experiments/torsion.toml).
double bar_torque(int across, bool twist_coupling) {
  const double h = 0.1 / across;
  Body body = body_of(make_box_grid({4 * across, across, across}, h), true);
  if (twist_coupling) {
    const double face = brick_law(Model::kSprings, kMaterial, h).face;
    body.small_strain_stiffness = with_twist_coupling(body.small_strain_stiffness, face);
  }
  const double angle = 10 * std::numbers::pi / 180;
  Supports supports(body.node_count());
  Points flipped = Points::Zero(body.node_count(), 3);
  Points arms = Points::Zero(body.node_count(), 3);
  for (int node = 0; node < body.node_count(); ++node) {
    const int x = body.grid.lattice[node].x();
    if (x == 0) supports.fix(node);
    if (x != 4 * across) continue;
    supports.fix(node, 1);
    supports.fix(node, 2);
    arms.row(node) = body.positions.row(node);
    flipped(node, 1) = -angle * (arms(node, 2) - 0.05);
    flipped(node, 2) = angle * (arms(node, 1) - 0.05);
  }
  const Points none = Points::Zero(body.node_count(), 3);
  const LinearResponse response = linear_response(body, supports, none, flipped, *make_direct_solver());
  return flipped.cwiseProduct(response.reactions).sum() / angle / 0.002368735;
}

/// The work of unit shear stress on the faces of a free unit cube, over that of an elastic one.
double sheared_cube_yield(int bricks, bool corner_coupling) {
  const double h = 1.0 / bricks;
  const Body body = body_of(make_box_grid({bricks, bricks, bricks}, h), corner_coupling);
  Points loads = Points::Zero(body.node_count(), 3);
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 2; ++axis) {
        const bool high = on_high_side(corner, axis);
        if (body.grid.cells[brick][axis] != (high ? bricks - 1 : 0)) continue;
        loads(body.grid.nodes[brick][corner], 1 - axis) += (high ? 1 : -1) * h * h / 4;
      }
    }
  }
  Supports supports(body.node_count());
  for (int node = 0; node < body.node_count(); ++node) {  // against rigid motion only: no forces there
    const Eigen::Vector3i& place = body.grid.lattice[node];
    if (place == Eigen::Vector3i(0, 0, 0)) supports.fix(node);
    if (place == Eigen::Vector3i(bricks, 0, 0)) supports.fix(node, 1);
    if (place == Eigen::Vector3i(bricks, 0, 0) || place == Eigen::Vector3i(0, bricks, 0)) supports.fix(node, 2);
  }
  const Eigen::VectorXd u = solve_linear(body, supports, loads, *make_direct_solver());
  return u.dot(Eigen::Map<const Eigen::VectorXd>(loads.data(), loads.size())) * kMaterial.shear_modulus();
}

/// Tip sag of the L-bracket of assets/experiments/l_bracket.toml, `across` bricks thick, over that of converged finite
/// elements. `corner_stiffness`: share of a full brick's that the three columns at the re-entrant edge have.
double bracket_sag(int across, bool corner_coupling, double corner_stiffness) {
  BrickGrid grid;
  grid.brick_size = 0.1 / across;
  for (int z = 0; z < across; ++z) {
    for (int y = 0; y < 2 * across; ++y) {
      for (int x = 0; x < (y < across ? across : 3 * across); ++x) grid.cells.emplace_back(x, y, z);
    }
  }
  grid.fill.assign(grid.cells.size(), 1);
  number_nodes(grid);
  Body body = body_of(std::move(grid), corner_coupling);
  for (std::size_t brick = 0; brick < body.grid.cells.size(); ++brick) {
    const auto at_edge = [&](int cell) { return cell == across - 1 || cell == across; };
    const Eigen::Vector3i& cell = body.grid.cells[brick];
    if (at_edge(cell.x()) && at_edge(cell.y())) body.stiffness_scale[brick] = corner_stiffness;
  }
  Supports supports(body.node_count());
  Points loads = Points::Zero(body.node_count(), 3);
  loads.col(1) = -body.masses;
  std::vector<int> tip;  // the node in the middle of the end, or the four around it
  for (int node = 0; node < body.node_count(); ++node) {
    const Eigen::Vector3i& place = body.grid.lattice[node];
    if (place.y() == 0) supports.fix(node);
    const int off = std::max(std::abs(2 * place.y() - 3 * across), std::abs(2 * place.z() - across));
    if (place.x() == 3 * across && off <= across % 2) tip.push_back(node);
  }
  const Eigen::VectorXd u = solve_linear(body, supports, loads, *make_direct_solver());
  double sum = 0;
  for (const int node : tip) sum -= u[3 * node + 1];
  return sum / double(tip.size()) / 0.00168401;
}

TEST(BrickLimits, WithoutTheCornerCouplingTheXyzModesAreTheHexahedrons) {
  const BrickMatrix hexahedron = hexahedron_stiffness(kMaterial, 0.1);
  const BrickMatrix brick = test::rest_stiffness(Model::kSprings, kMaterial, 0.1);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix<double, 24, 1> mode = 8 * share_of_mode(axis, kXyz).transpose();
    const double size = (hexahedron * mode).norm();
    EXPECT_LT((without_corner_coupling(brick) * mode - hexahedron * mode).norm(), 1e-12 * size);
    EXPECT_GT((brick * mode - hexahedron * mode).norm(), 0.1 * size);
  }
}

TEST(BrickLimits, ACouplingOfTwistsWouldMendTheTorsionOfABarOfOneBrickOnly) {
  EXPECT_NEAR(bar_torque(1, false), 1.18, 0.01);
  EXPECT_NEAR(bar_torque(2, false), 1.18, 0.01);
  EXPECT_NEAR(bar_torque(4, false), 1.05, 0.01);
  EXPECT_NEAR(bar_torque(1, true), 1.00, 0.01);
  EXPECT_NEAR(bar_torque(2, true), 1.13, 0.01);
  EXPECT_NEAR(bar_torque(4, true), 1.04, 0.01);
}

TEST(BrickLimits, AFreeCubeUnderShearYieldsAtItsCorners) {
  EXPECT_NEAR(sheared_cube_yield(1, true), 3.00, 0.005);
  EXPECT_NEAR(sheared_cube_yield(2, true), 1.08, 0.005);
  EXPECT_NEAR(sheared_cube_yield(4, true), 1.01, 0.005);
  EXPECT_NEAR(sheared_cube_yield(1, false), 1, 1e-10);
  EXPECT_NEAR(sheared_cube_yield(2, false), 1, 1e-10);
}

TEST(BrickLimits, TheBracketWouldBeStifferWithoutTheCornerCoupling) {
  EXPECT_NEAR(bracket_sag(1, true, 1), 0.998, 1e-3);
  EXPECT_NEAR(bracket_sag(2, true, 1), 0.921, 1e-3);
  EXPECT_NEAR(bracket_sag(4, true, 1), 0.957, 1e-3);
  EXPECT_NEAR(bracket_sag(1, false, 1), 0.858, 1e-3);
  EXPECT_NEAR(bracket_sag(2, false, 1), 0.899, 1e-3);
  EXPECT_NEAR(bracket_sag(4, false, 1), 0.951, 1e-3);
}

/// One number for all grids: the error is the singularity's, not the brick's.
TEST(BrickLimits, SofterBricksAtTheReentrantEdgeMendTheBracketOnEveryGrid) {
  for (const int across : {2, 4}) EXPECT_NEAR(bracket_sag(across, true, 0.8), 1, 0.01) << across;
}

}  // namespace
}  // namespace sprung
