#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/mesh/query/winding_tree.h"
#include "core/mesh/repair/solids.h"
#include "core/mesh/repair/submesh.h"
#include "tests/support/error_message.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using test::box_mesh;
using test::inside_out;
using test::joined;
using test::without_triangles;

const Vec3 kOne = Vec3::Ones();
const double kTorusVolume = 2 * std::numbers::pi * std::numbers::pi * 2 * 0.5 * 0.5;

std::string refusal(const SurfaceMesh& mesh, const SolidOptions& options = {}) {
  return error_message(ErrorKind::kBadInput, [&] { (void)find_solids(mesh, "thing.obj", options); });
}

/// Heights over a square of 1, 20 x 20 squares.
SurfaceMesh sheet_mesh(double height) {
  constexpr int kSide = 20;
  Points points((kSide + 1) * (kSide + 1), 3);
  Triangles triangles(2 * kSide * kSide, 3);
  for (int p = 0; p < points.rows(); ++p) {
    const double x = p % (kSide + 1) / double{kSide};
    const double z = p / (kSide + 1) / double{kSide};
    points.row(p) << x, height * std::sin(6 * x) * std::cos(5 * z), z;
  }
  for (int square = 0; square < kSide * kSide; ++square) {
    const int corner = square / kSide * (kSide + 1) + square % kSide;
    triangles.row(2 * square) << corner, corner + kSide + 1, corner + 1;
    triangles.row(2 * square + 1) << corner + 1, corner + kSide + 1, corner + kSide + 2;
  }
  return test::mesh_of(points, triangles);
}

SurfaceMesh moebius_band() {
  constexpr int kAround = 60;
  Points points(2 * kAround, 3);
  Triangles triangles(2 * kAround, 3);
  for (int i = 0; i < kAround; ++i) {
    const double a = 2 * std::numbers::pi * i / kAround;
    for (int side = 0; side < 2; ++side) {
      const double reach = (side == 0 ? -0.3 : 0.3);
      const double r = 1 + reach * std::cos(a / 2);
      points.row(2 * i + side) << r * std::cos(a), r * std::sin(a), reach * std::sin(a / 2);
    }
    const int swap = i + 1 == kAround ? 1 : 0;
    const int next = (2 * i + 2) % (2 * kAround);
    triangles.row(2 * i) << 2 * i, 2 * i + 1, next + swap;
    triangles.row(2 * i + 1) << 2 * i + 1, next + 1 - swap, next + swap;
  }
  return test::mesh_of(points, triangles);
}

TEST(Repair, LeavesASoundMeshAlone) {
  SurfaceMesh mesh = test::torus_mesh(2, 0.5);
  for (const RepairMode mode : {RepairMode::kOff, RepairMode::kAuto, RepairMode::kStrict}) {
    const Solids found = find_solids(mesh, "torus", {.repair = mode});
    EXPECT_TRUE(found.repairs.empty());
    const SurfaceMesh drawn = submesh(mesh, found.solids.at(0));
    EXPECT_EQ(drawn.triangles.rows(), mesh.triangles.rows());
    EXPECT_EQ(drawn.parts.size(), 1U);
    for (int t = 0; t < mesh.triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(drawn.positions.row(drawn.triangles(t, k)), mesh.positions.row(mesh.triangles(t, k)));
      }
    }
  }
}

TEST(Repair, ClosesAFlatHoleFlat) {
  // The box's last two triangles are its side x = 1.
  const SurfaceMesh open = without_triangles(box_mesh(Vec3::Zero(), kOne), 10, 2);
  const Solids found = find_solids(open, "box");
  EXPECT_EQ(test::count_of_kind(found, "hole_filled"), 1);
  const Solid& solid = found.solids.at(0);
  EXPECT_DOUBLE_EQ(solid.volume, 1);
  EXPECT_EQ(solid.points.rows(), 8) << "a flat cap has no points of its own";
  EXPECT_EQ(std::count(solid.source.begin(), solid.source.end(), -1), 2);
  EXPECT_EQ(voxelize(solid, 0.25).volume(), 1);
}

TEST(Repair, TheSkinGetsTheCaps) {
  SurfaceMesh open = without_triangles(box_mesh(Vec3::Zero(), kOne), 10, 2);
  open.uvs.setConstant(8, 2, 0.5F);
  open.normals.setZero(8, 3);
  const SurfaceMesh drawn = submesh(open, find_solids(open, "box").solids.at(0));
  ASSERT_EQ(drawn.triangles.rows(), 12);
  ASSERT_EQ(drawn.parts.size(), 2U);
  EXPECT_EQ(drawn.parts[1].name, "cap");
  EXPECT_EQ(drawn.parts[1].first_triangle, 10);
  EXPECT_EQ(drawn.positions.rows(), 12) << "the rim's four points once more";
  EXPECT_EQ(drawn.uvs.rows(), 12);
  for (int v = 8; v < 12; ++v) {
    EXPECT_EQ(drawn.normals.row(v), Eigen::RowVector3f(1, 0, 0));
    EXPECT_EQ(drawn.positions(v, 0), 1);
  }
}

TEST(Repair, ClosesACurvedHoleSmoothly) {
  // A quarter of the torus's length of its outer side.
  const SurfaceMesh whole = test::torus_mesh(2, 0.5, 96, 48);
  SurfaceMesh open = whole;
  std::vector<int> kept;
  for (int t = 0; t < whole.triangles.rows(); ++t) {
    const Eigen::RowVector3d middle = whole.positions(whole.triangles.row(t), Eigen::all).colwise().mean();
    if ((middle - Eigen::RowVector3d(2.5, 0, 0)).norm() > 0.4) kept.push_back(t);
  }
  open.triangles = whole.triangles(kept, Eigen::all);
  const Solids found = find_solids(open, "torus");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_EQ(test::count_of_kind(found, "hole_filled"), 1);
  EXPECT_NEAR(found.solids[0].volume / find_solids(whole, "torus").solids.at(0).volume, 1, 0.004);
  double furthest = 0;  // from the torus
  for (const auto& p : found.solids[0].points.rowwise()) {
    const double around = std::hypot(p.x(), p.y()) - 2;
    furthest = std::max(furthest, std::abs(std::hypot(around, p.z()) - 0.5));
  }
  EXPECT_LT(furthest, 0.06) << "a straight cap would be 0.15 away";
}

TEST(Repair, StitchesRimsThatAlmostMeet) {
  SurfaceMesh cracked = test::unwelded(test::torus_mesh(2, 0.5));
  std::mt19937 random(5);
  for (double& coordinate : cracked.positions.reshaped()) coordinate += 1e-4 * (double(random()) / 4294967296.0 - 0.5);
  const Solids found = find_solids(cracked, "torus");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_TRUE(found.solids[0].closed);
  EXPECT_GT(test::count_of_kind(found, "stitched"), 20000);
  EXPECT_EQ(test::count_of_kind(found, "hole_filled"), 0);
  EXPECT_NEAR(found.solids[0].volume / kTorusVolume, 1, 5e-3);
}

TEST(Repair, UnitesBodiesThatOverlap) {
  const SurfaceMesh mesh = joined(box_mesh(Vec3::Zero(), kOne), inside_out(box_mesh(0.5 * kOne, 1.5 * kOne)));
  const Solids found = find_solids(mesh, "boxes");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_EQ(test::count_of_kind(found, "united"), 2);
  EXPECT_EQ(test::count_of_kind(found, "inside_out"), 1);
  EXPECT_NEAR(enclosed_volume(found.solids[0]), 2 - 0.125, 1e-3);
  EXPECT_NEAR(voxelize(found.solids[0], 0.1).volume(), 2 - 0.125, 2e-3);
}

TEST(Repair, RefusesWhatEnclosesNothingByName) {
  EXPECT_NE(refusal(sheet_mesh(0))
                .find("the surface is flat (y extent 0) and encloses no volume; ask for a shell with "
                      "--thickness 3mm"),
            std::string::npos);
  EXPECT_NE(refusal(sheet_mesh(0.1)).find("open sheet (80 open edges in 1 loop)"), std::string::npos)
      << refusal(sheet_mesh(0.1));
  EXPECT_NE(refusal(moebius_band()).find("one-sided"), std::string::npos) << refusal(moebius_band());
}

/// A tray is a shell, not a block with a hole.
TEST(Repair, RefusesAHoleThatIsAsLargeAsItsSurface) {
  const SurfaceMesh tray = without_triangles(box_mesh(Vec3::Zero(), Vec3(0.2, 1, 1)), 10, 2);
  EXPECT_NE(refusal(tray).find("would be 36 % of the solid's surface; ask for a shell with --thickness"),
            std::string::npos)
      << refusal(tray);
  EXPECT_EQ(find_solids(tray, "tray", {.thickness = 0.05}).solids.size(), 1U);
}

TEST(Repair, RefusesTrianglesWithoutAnInside) {
  std::mt19937 random(3);
  Points points(3000, 3);
  for (double& coordinate : points.reshaped()) coordinate = double(random()) / 4294967296.0;
  for (int p = 0; p < points.rows(); ++p) points.row(p) = points.row(p) * 0.1 + points.row(p / 3 * 3);
  Triangles triangles(1000, 3);
  for (int t = 0; t < 1000; ++t) triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
  const std::string reason = refusal(test::mesh_of(points, triangles));
  EXPECT_NE(reason.find("1000 loose pieces that enclose no volume"), std::string::npos) << reason;
}

TEST(Repair, StrictNamesWhatWouldBeMended) {
  const SurfaceMesh open = inside_out(without_triangles(box_mesh(Vec3::Zero(), kOne), 10, 2));
  const std::string reason = refusal(open, {.repair = RepairMode::kStrict});
  EXPECT_NE(reason.find("--repair strict"), std::string::npos) << reason;
  EXPECT_NE(reason.find("filled 1 hole"), std::string::npos) << reason;
  EXPECT_NE(reason.find("inside-out"), std::string::npos) << reason;
}

TEST(Repair, OffRefusesWhatIsNotClosed) {
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kOne);
  const SolidOptions off{.repair = RepairMode::kOff};
  EXPECT_NE(refusal(without_triangles(mesh, 10, 2), off).find("4 open edges in 1 loop"), std::string::npos);
  mesh.triangles.row(0).reverseInPlace();
  EXPECT_NE(refusal(mesh, off).find("1 triangle turned against"), std::string::npos) << refusal(mesh, off);
}

class Scaled : public ::testing::TestWithParam<double> {};

TEST_P(Scaled, SameRepairsAndSameBricks) {
  const SurfaceMesh ring = without_triangles(test::torus_mesh(2, 0.5, 48, 24), 100, 300);
  const SurfaceMesh mesh = joined(ring, box_mesh(Vec3(1.9, -0.2, -0.2), Vec3(3, 0.2, 0.2)));
  SurfaceMesh scaled = mesh;
  scaled.positions *= GetParam();
  const Solids expected = find_solids(mesh, "mesh");
  const Solids found = find_solids(scaled, "mesh");
  ASSERT_EQ(found.solids.size(), 1U);
  ASSERT_EQ(found.repairs.size(), expected.repairs.size());
  for (std::size_t i = 0; i < found.repairs.size(); ++i) EXPECT_EQ(found.repairs[i].text, expected.repairs[i].text);
  const BrickGrid a = voxelize(expected.solids.at(0), 0.1);
  const BrickGrid b = voxelize(found.solids[0], 0.1 * GetParam());
  ASSERT_EQ(a.cells, b.cells);
  for (std::size_t i = 0; i < a.fill.size(); ++i) EXPECT_NEAR(a.fill[i], b.fill[i], 0.02);
}

INSTANTIATE_TEST_SUITE_P(Repair, Scaled, ::testing::Values(1e-6, 1e6));

TEST(WindingTree, AgreesWithTheSolidAngles) {
  const SurfaceMesh mesh = without_triangles(test::torus_mesh(2, 0.5, 48, 24), 0, 400);
  const WindingTree tree(mesh.positions, mesh.triangles);
  std::mt19937 random(7);
  for (int i = 0; i < 500; ++i) {
    const auto coordinate = [&](double reach) { return reach * (double(random()) / 2147483648.0 - 1); };
    const Vec3 place(coordinate(3), coordinate(3), coordinate(1));
    double angle = 0;
    for (const auto& t : mesh.triangles.rowwise()) {
      angle += solid_angle(mesh.positions.row(t[0]), mesh.positions.row(t[1]), mesh.positions.row(t[2]), place);
    }
    EXPECT_NEAR(tree.at(place), angle / (4 * std::numbers::pi), 0.03);
  }
}

/// Whether all bricks are connected by their faces.
bool hangs_together(const BrickGrid& grid) {
  std::set<std::array<int, 3>> left;
  for (const auto& cell : grid.cells) left.insert({cell.x(), cell.y(), cell.z()});
  std::vector<std::array<int, 3>> reached{*left.begin()};
  left.erase(left.begin());
  while (!reached.empty()) {
    const std::array<int, 3> from = reached.back();
    reached.pop_back();
    for (std::size_t side = 0; side < 6; ++side) {
      std::array<int, 3> to = from;
      to[side / 2] += side % 2 == 0 ? -1 : 1;
      if (left.erase(to) > 0) reached.push_back(to);
    }
  }
  return left.empty();
}

TEST(Thickness, MakesASheetAShell) {
  const SurfaceMesh flat = sheet_mesh(0);
  const Solids found = find_solids(flat, "sheet", {.thickness = 0.1});
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_NEAR(found.solids[0].volume, 0.1 + 4 * std::numbers::pi / 8 * 0.01, 1e-12);
  const BrickGrid grid = voxelize(found.solids[0], 0.1);
  EXPECT_TRUE(std::all_of(grid.cells.begin(), grid.cells.end(), [](const auto& cell) { return cell.y() == 0; }));
  EXPECT_NEAR(grid.volume() / found.solids[0].volume, 1, 0.02);
  EXPECT_EQ(submesh(flat, found.solids[0]).triangles.rows(), flat.triangles.rows());
}

TEST(Thickness, BricksHangTogetherAndHoldTheMass) {
  const SurfaceMesh wavy = sheet_mesh(0.3);
  const double area = find_solids(wavy, "sheet", {.thickness = 1e-6}).solids.at(0).volume / 1e-6;
  for (const double bricks : {0.2, 0.5, 1.0, 1.7, 3.0}) {  // along the thickness
    const double thickness = 0.05;
    const Solids found = find_solids(wavy, "sheet", {.thickness = thickness});
    const BrickGrid grid = voxelize(found.solids.at(0), thickness / bricks);
    EXPECT_TRUE(hangs_together(grid)) << bricks;
    EXPECT_NEAR(grid.volume() / (area * thickness), 1, 0.15) << bricks;
  }
  for (const SurfaceMesh& mesh : {moebius_band(), test::torus_mesh(2, 0.5, 48, 24)}) {
    const Solids found = find_solids(mesh, "shell", {.thickness = 0.1});
    EXPECT_TRUE(hangs_together(voxelize(found.solids.at(0), 0.1)));
  }
}

}  // namespace
}  // namespace sprung
