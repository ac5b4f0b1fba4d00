#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/bricks/voxelize.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/repair/solids.h"
#include "core/mesh/repair/submesh.h"
#include "tests/external/external_mesh.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

/// Clean surfaces: nothing needs repair.
constexpr std::array kSound{"spot_triangulated.obj",       "bunny.obj",          "eight.off",   "bob_small.ply",
                            "scorpion_low_resolution.obj", "test_pos_color.ply", "scallop.glb", "unit_cube.STL",
                            "large_block_obb.STL",         "plate_holes.STL",    "sphere.dae",  "huesitos.fbx",
                            "double-torus-example.off"};

constexpr std::array kMended{"bun_zipper.ply",
                             "teapot_instancenodes.DAE",
                             "cube_gears.3mf",
                             "self_intersectA.obj",
                             "openscad-nonmanifold-crash.obj",
                             "blobby-shuffled.off",
                             "ellipe0.003.off",
                             "Duck.glb",
                             "sphereWithHole.stl",
                             "Spider_binary.stl",
                             "hand_lowres.obj"};

std::string test_name(const testing::TestParamInfo<const char*>& tested) {
  std::string name = tested.param;
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
  return name;
}

SurfaceMesh recentred(SurfaceMesh mesh) {
  const Eigen::RowVector3d middle = (mesh.positions.colwise().minCoeff() + mesh.positions.colwise().maxCoeff()) / 2;
  mesh.positions.rowwise() -= middle;
  return mesh;
}

double longest_side(const SurfaceMesh& mesh) {
  return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
}

class ExternalMeshes : public ::testing::TestWithParam<const char*> {
 protected:
  static std::filesystem::path file() { return test::external_mesh(GetParam()); }
};

class SoundMeshes : public ExternalMeshes {};

TEST_P(SoundMeshes, KeepTheirSkins) {
  const SurfaceMesh mesh = recentred(read_mesh(file()));
  Eigen::Index triangles = 0;
  for (const Solid& solid : find_solids(mesh, GetParam(), {.repair = RepairMode::kStrict}).solids) {
    triangles += submesh(mesh, solid).triangles.rows();
  }
  EXPECT_EQ(triangles, mesh.triangles.rows());
}

INSTANTIATE_TEST_SUITE_P(All, SoundMeshes, ::testing::ValuesIn(kSound), test_name);

TEST_P(ExternalMeshes, AreTheSameAtAnyScale) {
  const SurfaceMesh mesh = recentred(read_mesh(file()));
  const Solids expected = find_solids(mesh, GetParam());
  for (const double scale : {1e-6, 1e6}) {
    SurfaceMesh scaled = mesh;
    scaled.positions *= scale;
    const Solids found = find_solids(scaled, GetParam());
    EXPECT_EQ(notes_of(found.repairs), notes_of(expected.repairs));
    ASSERT_EQ(found.solids.size(), expected.solids.size());
    for (std::size_t i = 0; i < found.solids.size(); ++i) {
      EXPECT_EQ(voxelize(found.solids[i], scale * longest_side(mesh) / 16).cells,
                voxelize(expected.solids[i], longest_side(mesh) / 16).cells);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sound, ExternalMeshes, ::testing::ValuesIn(kSound), test_name);
INSTANTIATE_TEST_SUITE_P(Mended, ExternalMeshes, ::testing::ValuesIn(kMended), test_name);

/// The fraction of the bricks' volume above a height.
double volume_above(const BrickGrid& grid, double share_of_height) {
  int top = 0;
  for (const auto& cell : grid.cells) top = std::max(top, cell.y());
  double above = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (grid.cells[i].y() > share_of_height * top) above += grid.fill[i] * grid.brick_volume();
  }
  return above / grid.volume();
}

TEST(ExternalScan, EarsAndHeadNeitherFillNorLeak) {
  const auto scan = test::external_mesh("bun_zipper.ply");
  const auto whole = test::external_mesh("bunny.obj");
  const SurfaceMesh mesh = read_mesh(scan);
  const SurfaceMesh sound = read_mesh(whole);
  const Solids found = find_solids(mesh, "scan");
  EXPECT_EQ(test::count_of_kind(found, "hole_filled"), 5);
  EXPECT_EQ(test::count_of_kind(found, "unreferenced"), 1113);
  // The same animal, remeshed without holes.
  const BrickGrid a = voxelize(found.solids.at(0), longest_side(mesh) / 48);
  const BrickGrid b = voxelize(find_solids(sound, "bunny").solids.at(0), longest_side(sound) / 48);
  EXPECT_NEAR(a.volume() / std::pow(longest_side(mesh), 3) / (b.volume() / std::pow(longest_side(sound), 3)), 1, 0.03);
  for (const double height : {0.5, 0.7, 0.85}) {
    EXPECT_NEAR(volume_above(a, height) / volume_above(b, height), 1, 0.1) << height;
  }
}

TEST(ExternalHand, WristIsClosedFlat) {
  const auto file = test::external_mesh("hand_lowres.obj");
  const SurfaceMesh mesh = read_mesh(file);
  const Solid solid = find_solids(mesh, "hand").solids.at(0);
  EXPECT_EQ(std::count(solid.source.begin(), solid.source.end(), -1), 14) << "16 edges and no point inside";
}

TEST(ExternalGears, StayApartAtFineBricks) {
  const auto file = test::external_mesh("cube_gears.3mf");
  const SurfaceMesh mesh = read_mesh(file);
  const Solids found = find_solids(mesh, "gears");
  ASSERT_EQ(found.solids.size(), 17U);
  double volume = 0;
  for (const Solid& solid : found.solids) volume += voxelize(solid, longest_side(mesh) / 192).volume();
  EXPECT_NEAR(volume / 1.124e5, 1, 2e-3);
}

TEST(ExternalLego, IsAShellWhereAThicknessIsGiven) {
  const auto file = test::external_mesh("lego.ply");
  const Solids found = find_solids(read_mesh(file), "lego", {.thickness = 0.02});
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_NEAR(voxelize(found.solids[0], 0.02).volume() / found.solids[0].volume, 1, 0.05);
}

}  // namespace
}  // namespace sprung
