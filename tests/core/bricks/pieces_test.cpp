#include "core/bricks/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/bricks/embedding.h"
#include "core/bricks/slivers.h"
#include "core/bricks/voxelize.h"
#include "core/disjoint_sets.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/comb.h"

namespace sprung {
namespace {

using test::comb_mesh;

BrickGrid split(const Solid& solid, double size, PieceReport* report = nullptr) {
  BrickGrid grid = voxelize(solid, size);
  const PieceReport found = split_pieces(solid, grid);
  if (report != nullptr) *report = found;
  return grid;
}

Solid only(const SurfaceMesh& mesh) { return find_solids(mesh, "test").solids.at(0); }

/// For each brick the number, from 0, of its connected component once those for which `is_out` holds are removed; -1
/// for these.
template <class IsOut>
std::vector<int> pieces_without(const BrickGrid& grid, const IsOut& is_out) {
  DisjointSets sets(grid.lattice.size());
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    for (const int node : grid.nodes[i]) {
      if (!is_out(i)) sets.merge(grid.nodes[i][0], node);
    }
  }
  std::vector<int> names;
  std::vector<int> piece(grid.cells.size(), -1);
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (is_out(i)) continue;
    const int name = sets.find(grid.nodes[i][0]);
    auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) found = names.insert(names.end(), name);
    piece[i] = int(found - names.begin());
  }
  return piece;
}

int count_of_pieces(const std::vector<int>& piece) { return 1 + *std::max_element(piece.begin(), piece.end()); }

/// The guarantees of BrickGrid about its rows.
void expect_in_order(const BrickGrid& grid) {
  const auto before = [](const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
    return std::tuple(a.z(), a.y(), a.x()) < std::tuple(b.z(), b.y(), b.x());
  };
  EXPECT_TRUE(std::is_sorted(grid.cells.begin(), grid.cells.end(), before));
  EXPECT_TRUE(std::is_sorted(grid.lattice.begin(), grid.lattice.end(), before));
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto node = std::size_t(grid.nodes[i][corner]);
      const Eigen::Vector3i offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      ASSERT_EQ(grid.lattice.at(node), grid.cells[i] + offset);
    }
  }
}

TEST(SplitPieces, LeavesASolidWithoutGapsAsItIs) {
  for (const SurfaceMesh& mesh : {test::torus_mesh(2, 0.8), test::box_mesh(Vec3::Zero(), Vec3(2.5, 3.3, 4))}) {
    const Solid solid = only(mesh);
    const BrickGrid plain = voxelize(solid, 0.23);
    PieceReport report;
    const BrickGrid grid = split(solid, 0.23, &report);
    EXPECT_EQ(report.divided, 0);
    EXPECT_EQ(report.dropped, 0);
    EXPECT_EQ(report.floating, 0);
    EXPECT_GT(grid.brick_count(), 0.98 * plain.brick_count()) << "specks that no sample is in are given away";
    EXPECT_EQ(std::adjacent_find(grid.cells.begin(), grid.cells.end()), grid.cells.end());
    long repeated = 0;
    for (std::size_t m = 1; m < grid.lattice.size(); ++m) repeated += grid.lattice[m] == grid.lattice[m - 1] ? 1 : 0;
    EXPECT_LT(double(repeated), 0.005 * grid.node_count()) << "at slivers only";
    EXPECT_NEAR(grid.volume(), plain.volume(), 1e-9 * plain.volume());
    EXPECT_EQ(count_connected(grid), 1);
    expect_in_order(grid);
  }
}

TEST(SplitPieces, FingersInOneCellAreApartHoweverNarrowTheGap) {
  for (const double gap : {0.3, 0.05, 0.001}) {
    const Solid solid = only(comb_mesh({{0, 2.4}, {2.4 + gap, 4.7}}, 1.5, 6.2, 1.7));
    PieceReport report;
    const BrickGrid grid = split(solid, 1, &report);
    EXPECT_EQ(report.divided, 12) << gap;
    EXPECT_EQ(count_connected(grid), 1) << gap;
    EXPECT_NEAR(grid.volume(), solid.volume, 1e-9 * solid.volume) << gap;
    // Both stand on the brick at their roots, and share the nodes of its upper face.
    const std::vector<int> piece = pieces_without(grid, [&](std::size_t i) { return grid.cells[i].y() < 3; });
    EXPECT_EQ(count_of_pieces(piece), 2) << gap;
    expect_in_order(grid);
    for (std::size_t i = 0; i + 1 < grid.cells.size(); ++i) {
      if (grid.cells[i] != grid.cells[i + 1] || grid.cells[i].y() < 2 || grid.cells[i].y() > 6) continue;
      const double depth = grid.cells[i].z() == 0 ? 1 : 0.7;
      EXPECT_NEAR(grid.fill[i], 0.4 * depth, 0.06) << "sampled eight times along a side";
      EXPECT_NEAR(grid.fill[i + 1], (0.6 - gap) * depth, 0.06);
    }
  }
}

TEST(SplitPieces, FingersInNeighbouringCellsShareNoNodes) {
  const Solid solid = only(comb_mesh({{0, 2}, {2.02, 4}}, 2, 5, 2));
  const BrickGrid grid = split(solid, 1);
  const std::vector<int> piece = pieces_without(grid, [&](std::size_t i) { return grid.cells[i].y() < 3; });
  EXPECT_EQ(count_of_pieces(piece), 2);
}

TEST(SplitPieces, HoldsHoweverTheFingersLie) {
  SurfaceMesh mesh = comb_mesh({{0, 1.3}, {1.4, 2.2}, {2.25, 4}}, 2, 7, 1.6);
  for (int turn = 1; turn < 6; ++turn) {
    const Mat3 rotation = Eigen::AngleAxisd(0.7 * turn, Vec3(1, 2, turn).normalized()).toRotationMatrix();
    SurfaceMesh flipped = mesh;
    flipped.positions = mesh.positions * rotation.transpose();
    const Solid solid = only(flipped);
    PieceReport report;
    const BrickGrid grid = split(solid, 1, &report);
    EXPECT_GT(report.divided, 0) << turn;
    EXPECT_EQ(count_connected(grid), 1) << turn;
    EXPECT_NEAR(grid.volume(), solid.volume, 1e-9 * solid.volume) << turn;
    const auto is_back = [&](std::size_t i) {
      const Vec3 middle = grid.origin + grid.cells[i].cast<double>() + Vec3::Constant(0.5);
      return (rotation.transpose() * middle).y() < 4.8;
    };
    EXPECT_EQ(count_of_pieces(pieces_without(grid, is_back)), 3) << turn;
    expect_in_order(grid);
  }
}

/// The tooth of every brick above the back, by the x of the tooth at its position.
class PieceEmbedding : public ::testing::Test {
 protected:
  const Solid solid_ = only(comb_mesh({{0, 2.4}, {2.45, 4.7}}, 1.5, 6.2, 1.7));
  BrickGrid grid_ = split(solid_, 1);

  /// Points on the four sides of both teeth, and their outward normals.
  void list_points(Points& points, Points& normals, std::vector<int>& tooth) const {
    std::vector<Vec3> places;
    std::vector<Vec3> outwards;
    for (double y = 3.57; y < 7.6; y += 0.13) {
      for (const auto& [x, side, name] : {std::tuple{0.0, -1, 0}, {2.4, 1, 0}, {2.45, -1, 1}, {4.7, 1, 1}}) {
        for (double z = 0.02; z < 1.7; z += 0.17) {
          places.emplace_back(x, y, z);
          outwards.emplace_back(side, 0, 0);
          tooth.push_back(name);
        }
      }
      for (double x = 0.03; x < 4.7; x += 0.11) {
        if (x > 2.4 && x < 2.45) continue;
        places.emplace_back(x, y, 1.7);
        outwards.emplace_back(0, 0, 1);
        tooth.push_back(x < 2.42 ? 0 : 1);
      }
    }
    points.resize(places.size(), 3);
    normals.resize(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      points.row(i) = places[i];
      normals.row(i) = outwards[i];
    }
  }

  void expect_own_bricks() const {
    Points points;
    Points normals;
    std::vector<int> tooth;
    list_points(points, normals, tooth);
    const std::vector<int> piece = pieces_without(grid_, [&](std::size_t i) { return grid_.cells[i].y() < 3; });
    const Embedding embedding = embed(grid_, points, normals);
    int wrong = 0;
    for (std::size_t i = 0; i < tooth.size(); ++i) {
      wrong += piece[embedding.brick[i]] != tooth[i] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0) << "of " << tooth.size() << " points";
    EXPECT_LT(embedding.furthest, 1);
  }
};

TEST_F(PieceEmbedding, EveryPointOfAFingerIsInItsOwnBricks) { expect_own_bricks(); }

TEST_F(PieceEmbedding, AlsoWhereSliversWereGivenAway) {
  EXPECT_GT(absorb_slivers(grid_, 0.5), 0);
  EXPECT_NEAR(grid_.volume(), solid_.volume, 1e-9 * solid_.volume);
  expect_in_order(grid_);
  expect_own_bricks();
}

TEST(SplitPieces, ThinSheetsStayInOnePiece) {
  for (int turn = 0; turn < 5; ++turn) {
    const Mat3 rotation = Eigen::AngleAxisd(0.4 * turn, Vec3(1, turn, 2).normalized()).toRotationMatrix();
    SurfaceMesh sheet = test::box_mesh(Vec3(0, 0, 0), Vec3(7.3, 5.2, 0.06));
    sheet.positions = sheet.positions * rotation.transpose();
    const Solid solid = only(sheet);
    PieceReport report;
    const BrickGrid plain = voxelize(solid, 1);
    const BrickGrid grid = split(solid, 1, &report);
    EXPECT_EQ(count_connected(grid), 1) << turn;
    EXPECT_EQ(report.divided, 0) << turn;
    EXPECT_EQ(report.dropped, 0) << turn;
    EXPECT_NEAR(grid.volume(), plain.volume(), 1e-9) << turn;
  }
}

TEST(SplitPieces, SpecksAreDroppedAndCountedLargerPiecesSaid) {
  const SurfaceMesh large = test::box_mesh(Vec3::Zero(), Vec3(6, 6, 6));
  for (const auto& [side, dropped, floating] : {std::tuple{0.2, 1, 0}, {0.9, 0, 1}}) {
    const SurfaceMesh both = test::joined(large, test::box_mesh(Vec3(9, 1, 1), Vec3::Constant(side) + Vec3(9, 1, 1)));
    const double volume = 216 + side * side * side;
    const Solid solid{both.positions, both.triangles, {}, {}, volume};
    PieceReport report;
    const BrickGrid grid = split(solid, 1, &report);
    EXPECT_EQ(report.dropped, dropped);
    EXPECT_EQ(report.floating, floating);
    EXPECT_NEAR(report.dropped_volume, dropped * side * side * side, 1e-3);
    EXPECT_NEAR(grid.volume(), volume, 1e-9);
    EXPECT_EQ(count_connected(grid), 1 + floating);
  }
}

TEST(SplitPieces, IsDeterministic) {
  const Solid solid = only(comb_mesh({{0, 1.3}, {1.4, 2.2}, {2.25, 4}}, 2, 7, 1.6));
  const BrickGrid a = split(solid, 0.7);
  const BrickGrid b = split(solid, 0.7);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.fill, b.fill);
  EXPECT_EQ(a.nodes, b.nodes);
}

}  // namespace
}  // namespace sprung
