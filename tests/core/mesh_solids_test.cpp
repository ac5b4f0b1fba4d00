#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "core/mesh/read_mesh.h"
#include "core/mesh/solids.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

using test::box_mesh;
using test::inside_out;
using test::joined;

const Vec3 kOne = Vec3::Ones();

std::string refusal(const SurfaceMesh& mesh) {
  try {
    (void)find_solids(mesh, "thing.obj");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return error.what();
  }
  return "nothing was refused";
}

bool has_note(const Solids& found, const std::string& text) {
  const std::vector<std::string> notes = notes_of(found.repairs);
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

/// The signed volume of a solid's own triangles.
double volume_of(const Solid& solid) {
  double sum = 0;
  for (int t = 0; t < solid.triangles.rows(); ++t) {
    const Vec3 a = solid.points.row(solid.triangles(t, 0));
    const Vec3 b = solid.points.row(solid.triangles(t, 1));
    const Vec3 c = solid.points.row(solid.triangles(t, 2));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

TEST(FindSolids, WeldsByPosition) {
  const Solids found = find_solids(test::unwelded(box_mesh(Vec3::Zero(), Vec3(1, 2, 3))), "box");
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_EQ(found.solids[0].points.rows(), 8);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 6);
  EXPECT_TRUE(notes_of(found.repairs).empty());
}

TEST(FindSolids, TurnsAnInsideOutSurface) {
  const Solids found = find_solids(inside_out(box_mesh(Vec3::Zero(), kOne)), "box");
  EXPECT_NEAR(volume_of(found.solids.at(0)), 1, 1e-15);
  EXPECT_TRUE(has_note(found, "inside-out"));
}

TEST(FindSolids, TurnsSingleTrianglesToAgree) {
  SurfaceMesh mesh = test::torus_mesh(2, 0.5);
  for (int t = 0; t < mesh.triangles.rows(); t += 3) std::swap(mesh.triangles(t, 0), mesh.triangles(t, 1));
  const Solids found = find_solids(mesh, "torus");
  EXPECT_NEAR(volume_of(found.solids.at(0)), find_solids(test::torus_mesh(2, 0.5), "torus").solids.at(0).volume, 1e-12);
  EXPECT_TRUE(has_note(found, "turned 3072 triangles"));
}

TEST(FindSolids, DropsTrianglesWithoutAreaAndRepeatedOnes) {
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kOne);
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
  // The edge 4-6 of the box gets a middle point that only one of its two triangles knows: a sliver closes the gap.
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kOne);
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
  const SurfaceMesh mesh = joined(box_mesh(Vec3::Zero(), kOne), box_mesh(Vec3(3, 0, 0), Vec3(5, 1, 1)));
  const Solids found = find_solids(mesh, "boxes");
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 2) << "the largest comes first";
  EXPECT_EQ(found.solids[0].source.front(), 12);
  EXPECT_EQ(found.solids[1].source.front(), 0);
}

TEST(FindSolids, GivesACavityToTheSolidAroundIt) {
  const SurfaceMesh outer = box_mesh(Vec3::Zero(), 4 * kOne);
  const SurfaceMesh hole = inside_out(box_mesh(kOne, 3 * kOne));
  const SurfaceMesh stone = box_mesh(1.5 * kOne, 2.5 * kOne);
  const Solids found = find_solids(joined(joined(hole, outer), stone), "nut");
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 64 - 8);
  EXPECT_NEAR(volume_of(found.solids[0]), 64 - 8, 1e-12);
  EXPECT_DOUBLE_EQ(found.solids[1].volume, 1);
  const Solids turned = find_solids(inside_out(joined(joined(hole, outer), stone)), "nut");
  EXPECT_DOUBLE_EQ(turned.solids.at(0).volume, 64 - 8);
  EXPECT_DOUBLE_EQ(turned.solids.at(1).volume, 1);
}

TEST(FindSolids, KeepsASolidInsideAnotherThatIsTurnedTheSameWay) {
  const Solids found = find_solids(joined(box_mesh(Vec3::Zero(), 4 * kOne), box_mesh(kOne, 3 * kOne)), "core");
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_DOUBLE_EQ(found.solids[0].volume, 64);
}

TEST(FindSolids, CountsOpenEdges) {
  SurfaceMesh mesh = box_mesh(Vec3::Zero(), kOne);
  mesh.triangles.conservativeResize(10, 3);
  EXPECT_NE(refusal(mesh).find("thing.obj: the surface does not enclose a solid: 4 open edges in 1 loop"),
            std::string::npos)
      << refusal(mesh);
}

TEST(FindSolids, CountsEdgesThatAreNotManifold) {
  // Two boxes that share one edge.
  const SurfaceMesh mesh = joined(box_mesh(Vec3::Zero(), kOne), box_mesh(Vec3(1, 1, 0), Vec3(2, 2, 1)));
  EXPECT_NE(refusal(mesh).find("1 edge with more than two triangles"), std::string::npos) << refusal(mesh);
}

TEST(FindSolids, RefusesWhatEnclosesNothing) {
  const SurfaceMesh flat = box_mesh(Vec3::Zero(), Vec3(1, 0, 1));
  EXPECT_NE(refusal(flat).find("flat (y extent 0)"), std::string::npos) << refusal(flat);
  Points square(4, 3);
  square << 0, 0, 0, 1, 1, 0, 1, 1, 1, 0, 0, 1;
  Triangles folded(4, 3);
  folded << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  const SurfaceMesh sheet = test::mesh_of(square, folded);
  EXPECT_NE(refusal(sheet).find("no volume"), std::string::npos) << refusal(sheet);
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

struct Known {
  const char* file;
  int solids;
  double volume;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.file; }

class KnownSolids : public ::testing::TestWithParam<Known> {};

TEST_P(KnownSolids, HaveTheirCountAndVolume) {
  const auto file = test::shared_mesh(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared meshes are not here";
  const Solids found = find_solids(read_mesh(file), GetParam().file);
  EXPECT_EQ(static_cast<int>(found.solids.size()), GetParam().solids);
  double volume = 0;
  for (const Solid& solid : found.solids) {
    EXPECT_GT(solid.volume, 0);
    EXPECT_EQ(static_cast<int>(solid.source.size()), solid.triangles.rows());
    volume += solid.volume;
  }
  EXPECT_NEAR(volume / GetParam().volume, 1, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Shared, KnownSolids,
                         ::testing::Values(Known{"spot_triangulated.obj", 1, 0.7183}, Known{"bunny.obj", 1, 0.7493},
                                           Known{"eight.off", 1, 0.04017}, Known{"bob_small.ply", 1, 0.6791},
                                           Known{"scorpion_low_resolution.obj", 1, 12.18},
                                           Known{"cube_gears.3mf", 17, 1.124e5}, Known{"self_intersectA.obj", 1, 0.148},
                                           Known{"blobby-shuffled.off", 1, 0.05008}, Known{"ellipe0.003.off", 1, 1.474},
                                           Known{"Duck.glb", 1, 1.196}, Known{"test_pos_color.ply", 1, 3.927},
                                           Known{"scallop.glb", 1, 41.28}, Known{"unit_cube.STL", 1, 1},
                                           Known{"large_block_obb.STL", 1, 8.458e8},
                                           Known{"plate_holes.STL", 1, 7.674e5}, Known{"sphere.dae", 1, 4.095e-6},
                                           Known{"huesitos.fbx", 1, 1.569e7},
                                           Known{"double-torus-example.off", 1, 65.0}));

struct Broken {
  const char* file;
  const char* reason;
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.file; }

class BrokenSurfaces : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenSurfaces, AreRefusedWithCounts) {
  const auto file = test::shared_mesh(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared meshes are not here";
  const std::string message = refusal(read_mesh(file));
  EXPECT_NE(message.find(GetParam().reason), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Shared, BrokenSurfaces,
    ::testing::Values(Broken{"bun_zipper.ply", "223 open edges in 5 loops"},
                      Broken{"teapot_instancenodes.DAE", "128 open edges in 12 loops"},
                      Broken{"sphereWithHole.stl", "9 open edges in 1 loop"},
                      Broken{"Spider_binary.stl", "72 open edges in 6 loops"},
                      Broken{"hand_lowres.obj", "16 open edges in 1 loop"},
                      Broken{"lego.ply", "the surface is flat (y extent 0) and encloses no volume"},
                      Broken{"openscad-nonmanifold-crash.obj", "edges with more than two triangles (non-manifold)"}));

}  // namespace
}  // namespace sprung
