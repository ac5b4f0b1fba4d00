#include "core/mesh/io/read_mesh.h"

#include <gtest/gtest.h>

#include "core/mesh/repair/solids.h"
#include "tests/external/external_mesh.h"

namespace sprung {
namespace {

TEST(ReadExternalMesh, KeepsColoursAndTextures) {
  const SurfaceMesh duck = read_mesh(test::external_mesh("Duck.glb"));
  EXPECT_EQ(duck.uvs.rows(), duck.positions.rows());
  EXPECT_EQ(duck.normals.rows(), duck.positions.rows());
  EXPECT_GT(duck.materials.at(duck.parts.at(0).material).texture.size(), 1000U);
  EXPECT_EQ(read_mesh(test::external_mesh("test_pos_color.ply")).colors.rows(), 114);
  EXPECT_EQ(read_mesh(test::external_mesh("scallop.glb")).colors.rows(), 60002);
  EXPECT_EQ(read_mesh(test::external_mesh("blobby-shuffled.off")).triangles.rows(), 4050);
  EXPECT_EQ(read_mesh(test::external_mesh("cube_gears.3mf")).parts.size(), 17U);
  const SurfaceMesh die = read_mesh(test::external_mesh("MUSTPASS_Chapter2.1_PartsRelationships.3mf"));
  EXPECT_NEAR(find_solids(die, "die").solids.at(0).volume, 8000, 1e-3);
  ASSERT_EQ(die.notes.size(), 1U);
  EXPECT_NE(die.notes[0].find("textures of 3MF"), std::string::npos);
}

TEST(ReadExternalMesh, KnowsTheUnitOfADeflatedArchive) {
  EXPECT_EQ(stated_unit(test::external_mesh("cube_gears.3mf")), "mm");
}

}  // namespace
}  // namespace sprung
