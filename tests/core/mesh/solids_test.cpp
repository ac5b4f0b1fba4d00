#include "core/mesh/repair/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "tests/support/error_message.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using test::box_mesh;
using test::inside_out;
using test::joined;

const Vec3 kUnitCorner = Vec3::Ones();

std::string refusal_of_solids(const SurfaceMesh& mesh, RepairMode repair = RepairMode::kOff) {
  return error_message(ErrorKind::kBadInput, [&] { (void)find_solids(mesh, "thing.obj", {.repair = repair}); });
}

bool has_note(const Solids& found, const std::string& text) {
  const std::vector<std::string> notes = notes_of(found.repairs);
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(Solids, FloatingSpecksAreDroppedAndCounted) {
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kUnitCorner);
  for (const double x : {2.0, 3.0}) mesh = joined(mesh, box_mesh(Vec3(x, 0, 0), Vec3(x + 0.03, 0.03, 0.03)));
  mesh = joined(mesh, box_mesh(Vec3(4, 0, 0), Vec3(4.1, 0.1, 0.1)));
  const Solids found = find_solids(mesh, "specks");
  EXPECT_EQ(found.solids.size(), 2U);
  EXPECT_TRUE(has_note(found, "dropped 2 floating specks"));
  EXPECT_EQ(find_solids(mesh, "specks", {.repair = RepairMode::kOff}).solids.size(), 4U);
  EXPECT_NE(refusal_of_solids(mesh, RepairMode::kStrict).find("2 floating specks"), std::string::npos);
}

TEST(FindSolids, WeldsByPosition) {
  const Solids found = find_solids(test::unwelded(box_mesh(Vec3::Zero(), Vec3(1, 2, 3))), "box");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_EQ(found.solids[0].points.rows(), 8);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 6);
  EXPECT_TRUE(notes_of(found.repairs).empty());
}

TEST(FindSolids, TurnsAnInsideOutSurface) {
  const Solids found = find_solids(inside_out(box_mesh(Vec3::Zero(), kUnitCorner)), "box");
  EXPECT_NEAR(test::signed_volume(found.solids.at(0).points, found.solids.at(0).triangles), 1, 1e-15);
  EXPECT_TRUE(has_note(found, "inside-out"));
}

TEST(FindSolids, TurnsSingleTrianglesToAgree) {
  SurfaceMesh mesh = test::torus_mesh(2, 0.5);
  for (int t = 0; t < mesh.triangles.rows(); t += 3) std::swap(mesh.triangles(t, 0), mesh.triangles(t, 1));
  const Solids found = find_solids(mesh, "torus");
  EXPECT_NEAR(test::signed_volume(found.solids.at(0).points, found.solids.at(0).triangles),
              find_solids(test::torus_mesh(2, 0.5), "torus").solids.at(0).volume, 1e-12);
  EXPECT_TRUE(has_note(found, "turned 3072 triangles"));
}

TEST(FindSolids, DropsTrianglesWithoutAreaAndRepeatedOnes) {
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kUnitCorner);
  mesh.triangles.conservativeResize(15, 3);
  mesh.triangles.row(12) = mesh.triangles.row(5);
  mesh.triangles.row(13) = Eigen::RowVector3i(0, 0, 4);
  mesh.triangles.row(14) = Eigen::RowVector3i(3, 3, 3);
  const Solids found = find_solids(mesh, "box");
  EXPECT_EQ(found.solids.at(0).triangles.rows(), 12);
  EXPECT_TRUE(has_note(found, "dropped 2 triangles without area"));
  EXPECT_TRUE(has_note(found, "dropped 1 repeated triangle"));
}

TEST(FindSolids, KeepsSliversThatHoldTheSurfaceTogether) {
  // The edge 4-6 of the box gets a midpoint that only one of its two triangles has: a sliver closes the gap.
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kUnitCorner);
  mesh.positions.conservativeResize(9, 3);
  mesh.positions.row(8) = 0.5 * (mesh.positions.row(4) + mesh.positions.row(6));
  int split = -1;
  for (int t = 0; t < 12; ++t) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.triangles(t, k) == 4 && mesh.triangles(t, (k + 1) % 3) == 6) split = t;
    }
  }
  ASSERT_GE(split, 0);
  int other = 0;
  while (mesh.triangles(split, other) == 4 || mesh.triangles(split, other) == 6) ++other;
  const int corner = mesh.triangles(split, other);
  mesh.triangles.conservativeResize(14, 3);
  mesh.triangles.row(split) = Eigen::RowVector3i(4, 8, corner);
  mesh.triangles.row(12) = Eigen::RowVector3i(8, 6, corner);
  mesh.triangles.row(13) = Eigen::RowVector3i(4, 6, 8);
  EXPECT_DOUBLE_EQ(find_solids(mesh, "box").solids.at(0).volume, 1);
}

TEST(FindSolids, KeepsSeparatePiecesApart) {
  const SurfaceMesh mesh = joined(box_mesh(Vec3::Zero(), kUnitCorner), box_mesh(Vec3(3, 0, 0), Vec3(5, 1, 1)));
  const Solids found = find_solids(mesh, "boxes");
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 2) << "the largest comes first";
  EXPECT_EQ(found.solids[0].source.front(), 12);
  EXPECT_EQ(found.solids[1].source.front(), 0);
}

TEST(FindSolids, GivesACavityToTheSolidAroundIt) {
  const SurfaceMesh outer = box_mesh(Vec3::Zero(), 4 * kUnitCorner);
  const SurfaceMesh hole = inside_out(box_mesh(kUnitCorner, 3 * kUnitCorner));
  const SurfaceMesh stone = box_mesh(1.5 * kUnitCorner, 2.5 * kUnitCorner);
  const Solids found = find_solids(joined(joined(hole, outer), stone), "nut");
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 64 - 8);
  EXPECT_NEAR(test::signed_volume(found.solids[0].points, found.solids[0].triangles), 64 - 8, 1e-12);
  EXPECT_DOUBLE_EQ(found.solids[1].volume, 1);
  const Solids flipped = find_solids(inside_out(joined(joined(hole, outer), stone)), "nut");
  EXPECT_DOUBLE_EQ(flipped.solids.at(0).volume, 64 - 8);
  EXPECT_DOUBLE_EQ(flipped.solids.at(1).volume, 1);
}

TEST(FindSolids, UnitesASolidWithTheOneAroundItThatIsTurnedTheSameWay) {
  const SurfaceMesh core = joined(box_mesh(Vec3::Zero(), 4 * kUnitCorner), box_mesh(kUnitCorner, 3 * kUnitCorner));
  const Solids found = find_solids(core, "core");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 64);
  EXPECT_TRUE(has_note(found, "united 2 bodies"));
  EXPECT_EQ(find_solids(core, "core", {.repair = RepairMode::kOff}).solids.size(), 2U);
}

TEST(FindSolids, CountsOpenEdges) {
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kUnitCorner);
  mesh.triangles.conservativeResize(10, 3);
  EXPECT_NE(refusal_of_solids(mesh).find("thing.obj: the surface does not enclose a solid: 4 open edges in 1 loop"),
            std::string::npos)
      << refusal_of_solids(mesh);
}

TEST(FindSolids, CutsBoxesThatShareAnEdgeApart) {
  const SurfaceMesh mesh = joined(box_mesh(Vec3::Zero(), kUnitCorner), box_mesh(Vec3(1, 1, 0), Vec3(2, 2, 1)));
  for (const SurfaceMesh& given :
       {mesh, joined(box_mesh(Vec3::Zero(), kUnitCorner), inside_out(box_mesh(Vec3(1, 1, 0), Vec3(2, 2, 1))))}) {
    const Solids found = find_solids(given, "boxes");
    ASSERT_EQ(found.solids.size(), 2U);
    EXPECT_DOUBLE_EQ(test::signed_volume(found.solids[0].points, found.solids[0].triangles), 1);
    EXPECT_DOUBLE_EQ(test::signed_volume(found.solids[1].points, found.solids[1].triangles), 1);
    EXPECT_TRUE(has_note(found, "1 edge with more than two triangles"));
  }
}

TEST(FindSolids, RefusesWhatEnclosesNothing) {
  const SurfaceMesh flat = box_mesh(Vec3::Zero(), Vec3(1, 0, 1));
  EXPECT_NE(refusal_of_solids(flat, RepairMode::kAuto).find("flat (y extent 0)"), std::string::npos)
      << refusal_of_solids(flat, RepairMode::kAuto);
  Points square(4, 3);
  square << 0, 0, 0, 1, 1, 0, 1, 1, 1, 0, 0, 1;
  Triangles folded(4, 3);
  folded << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  const SurfaceMesh sheet = test::mesh_of(square, folded);
  EXPECT_NE(refusal_of_solids(sheet, RepairMode::kAuto).find("no volume"), std::string::npos)
      << refusal_of_solids(sheet, RepairMode::kAuto);
}

TEST(FindSolids, HasNoAbsoluteTolerance) {
  SurfaceMesh mesh = test::torus_mesh(2, 0.5);
  const double volume = find_solids(mesh, "torus").solids.at(0).volume;
  SurfaceMesh tiny = mesh;
  tiny.positions *= 1e-9;
  EXPECT_NEAR(find_solids(tiny, "tiny").solids.at(0).volume / (volume * 1e-27), 1, 1e-12);
  mesh.positions.rowwise() += Eigen::RowVector3d(1e6, -2e6, 3e6);
  EXPECT_NEAR(find_solids(mesh, "far").solids.at(0).volume / volume, 1, 1e-8);
}

}  // namespace
}  // namespace sprung
