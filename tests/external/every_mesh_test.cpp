#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "tests/external/external_mesh.h"
#include "tests/support/mesh_row.h"

/// Every row of a table of meshes from elsewhere, given to the built program.
namespace sprung {
namespace {

const std::vector<MeshRow>& rows() {
  static const std::vector<MeshRow> kRows{
      {"spot_triangulated.obj", 2930, 5856, true, 1, 0.7183, {}, ""},
      {"bunny.obj", 3301, 6598, true, 1, 0.7493, {}, ""},
      {"bun_zipper.ply", 34834, 69451, false, 1, {}, {"hole_filled"}, "filled 5 holes"},
      // The handle of one pot reaches into the spout of the other: 44 of the file's 156 crossings.
      {"teapot_instancenodes.DAE",
       1058,
       2048,
       false,
       1,
       {},
       {"degenerate", "hole_filled", "united", "self_intersection"},
       "filled 12 holes"},
      {"eight.off", 315, 634, true, 1, 0.04017, {}, ""},
      {"bob_small.ply", 250, 500, true, 1, 0.6791, {}, ""},
      {"scorpion_low_resolution.obj", 6315, 12626, true, 1, 12.18, {}, "thinner than a brick"},
      {"cube_gears.3mf", 12852, 25692, true, 17, 1.124e5, {"degenerate", "self_intersection"}, "924 pairs"},
      // The table's 0.148 is the signed volume, which counts what is enclosed twice twice; finer and finer bricks
      // converge to the union.
      {"self_intersectA.obj", 8582, 17160, true, 1, 0.1427, {"self_intersection"}, "338 pairs"},
      {"openscad-nonmanifold-crash.obj",
       658,
       1442,
       true,
       1,
       {},
       {"non_manifold_split", "duplicate", "self_intersection"},
       "(non-manifold)"},
      {"blobby-shuffled.off", 2027, 4050, true, 1, 0.05008, {"oriented"}, "to agree with their neighbours"},
      {"ellipe0.003.off", 1556, 3108, true, 1, 1.474, {"inside_out"}, "outwards"},
      {"Duck.glb", 2108, 4212, true, 1, 1.196, {"self_intersection"}, "4 pairs"},
      {"test_pos_color.ply", 114, 224, true, 1, 3.927, {}, ""},
      {"scallop.glb", 60002, 120000, true, 1, 41.28, {}, ""},
      {"unit_cube.STL", 8, 12, true, 1, 1, {}, ""},
      {"large_block_obb.STL", 8, 12, true, 1, 8.458e8, {}, ""},
      {"plate_holes.STL", 618, 1252, true, 1, 7.674e5, {}, ""},
      {"sphere.dae", 382, 760, true, 1, 4.095e-6, {}, ""},
      {"huesitos.fbx", 62, 120, true, 1, 1.569e7, {}, "ignored 1 animation and a skin of 9 bones"},
      {"sphereWithHole.stl", 146, 285, false, 1, {}, {"hole_filled"}, "filled 1 hole"},
      // Its 18 parts touch and overlap: one spider.
      {"Spider_binary.stl",
       722,
       1368,
       false,
       1,
       {},
       {"degenerate", "oriented", "hole_filled", "united", "self_intersection"},
       "dropped 56 triangles without area"},
      {"hand_lowres.obj", 810, 1602, false, 1, {}, {"hole_filled"}, "filled 1 hole (1 flat"},
      refused("lego.ply", "the surface is flat (y extent 0) and encloses no volume; ask for a shell with --thickness"),
      {"double-torus-example.off", 231, 466, true, 1, 65.0, {}, ""},
      {"MUSTPASS_Chapter2.1_PartsRelationships.3mf", 8, 12, true, 1, 8000, {}, "textures of 3MF files"},
      refused("bad/empty.obj", "empty file"),
      refused("bad/malformed.obj", "face 1 refers to vertex 12 of 8 (index out of range)"),
      refused("bad/inf_nan.obj", "vertex 1 has a coordinate that is not finite"),
      refused("bad/truncated.glb", "file is shorter (700) than its header says (1012)"),
      refused("bad/points.ply", "no faces (a point cloud)"),
      refused("bad/OutOfMemory.off", "header declares 353535235358 vertices, more than the file can hold")};
  return kRows;
}

class EveryMesh : public testing::TestWithParam<MeshRow> {
 protected:
  TempFolder folder_;
};

TEST_P(EveryMesh, BehavesAsTheTableSays) {
  const std::string file = std::filesystem::canonical(test::external_mesh(GetParam().file)).string();
  // Sanitizers make it ten times slower: then bricks are too coarse to count the solids.
  expect_row(folder_, file, GetParam(), test::kSanitized ? 16 : 48);
}

INSTANTIATE_TEST_SUITE_P(All, EveryMesh, testing::ValuesIn(rows()), [](const auto& tested) {
  std::string name = tested.param.file;
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace sprung
