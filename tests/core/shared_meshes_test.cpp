#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/mesh/read_mesh.h"
#include "core/mesh/solids.h"
#include "core/mesh/submesh.h"
#include "tests/support/meshes.h"

namespace sprung {
namespace {

/// What a good tool does with a file of the shared meshes.
struct Row {
  const char* file;
  int solids;                        // 0: it must be refused
  std::optional<double> volume;      // in cubed units of the file
  std::vector<std::string> repairs;  // kinds that must be named, each with a warning
  std::string refusal;               // what the error must say
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.file; }

const std::vector<Row>& rows() {
  static const std::vector<Row> kRows{
      {"spot_triangulated.obj", 1, 0.7183, {}, ""},
      {"bunny.obj", 1, 0.7493, {}, ""},
      {"bun_zipper.ply", 1, {}, {"hole_filled"}, ""},
      // The handle of one pot reaches into the spout of the other: 44 of the file's 156 crossings.
      {"teapot_instancenodes.DAE", 1, {}, {"degenerate", "hole_filled", "united", "self_intersection"}, ""},
      {"eight.off", 1, 0.04017, {}, ""},
      {"bob_small.ply", 1, 0.6791, {}, ""},
      {"scorpion_low_resolution.obj", 1, 12.18, {}, ""},
      {"cube_gears.3mf", 17, 1.124e5, {"degenerate", "self_intersection"}, ""},
      // The signed volume, 0.148, counts what is enclosed twice twice; the union is what finer and finer bricks hold.
      {"self_intersectA.obj", 1, 0.14266, {"self_intersection"}, ""},
      {"openscad-nonmanifold-crash.obj", 1, {}, {"non_manifold_split", "duplicate", "self_intersection"}, ""},
      {"blobby-shuffled.off", 1, 0.05008, {"oriented"}, ""},
      {"ellipe0.003.off", 1, 1.474, {"inside_out"}, ""},
      {"Duck.glb", 1, 1.196, {"self_intersection"}, ""},
      {"test_pos_color.ply", 1, 3.927, {}, ""},
      {"scallop.glb", 1, 41.28, {}, ""},
      {"unit_cube.STL", 1, 1, {}, ""},
      {"large_block_obb.STL", 1, 8.458e8, {}, ""},
      {"plate_holes.STL", 1, 7.674e5, {}, ""},
      {"sphere.dae", 1, 4.095e-6, {}, ""},
      {"huesitos.fbx", 1, 1.569e7, {}, ""},
      {"sphereWithHole.stl", 1, {}, {"hole_filled"}, ""},
      {"Spider_binary.stl", 1, {}, {"degenerate", "oriented", "hole_filled", "united", "self_intersection"}, ""},
      {"hand_lowres.obj", 1, {}, {"hole_filled"}, ""},
      {"lego.ply",
       0,
       {},
       {},
       "the surface is flat (y extent 0) and encloses no volume; ask for a shell with --thickness"},
      {"double-torus-example.off", 1, 65.0, {}, ""},
  };
  return kRows;
}

SurfaceMesh recentred(SurfaceMesh mesh) {
  const Eigen::RowVector3d middle = (mesh.positions.colwise().minCoeff() + mesh.positions.colwise().maxCoeff()) / 2;
  mesh.positions.rowwise() -= middle;
  return mesh;
}

double longest_side(const SurfaceMesh& mesh) {
  return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
}

int count_of_kind(const Solids& found, const std::string& kind) {
  const auto repair = std::find_if(found.repairs.begin(), found.repairs.end(),
                                   [&](const Repair& candidate) { return candidate.kind == kind; });
  return repair == found.repairs.end() ? 0 : repair->count;
}

class SharedMeshes : public ::testing::TestWithParam<Row> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(file())) GTEST_SKIP() << "the shared meshes are not here";
  }
  static std::filesystem::path file() { return test::shared_mesh(GetParam().file); }
};

TEST_P(SharedMeshes, BecomeWhatTheyShould) {
  const Row& row = GetParam();
  const SurfaceMesh mesh = recentred(read_mesh(file()));
  if (row.solids == 0) {
    try {
      (void)find_solids(mesh, row.file);
      FAIL() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_NE(std::string(error.what()).find(row.refusal), std::string::npos) << error.what();
    }
    return;
  }
  const Solids found = find_solids(mesh, row.file);
  EXPECT_EQ(static_cast<int>(found.solids.size()), row.solids);
  double volume = 0;
  double skin_triangles = 0;
  for (const Solid& solid : found.solids) {
    volume += voxelize(solid, longest_side(mesh) / 48).volume();
    skin_triangles += static_cast<double>(submesh(mesh, solid).triangles.rows());
  }
  if (row.volume) {
    EXPECT_NEAR(volume / *row.volume, 1, 0.005);
  }
  std::vector<std::string> warned;
  for (const Repair& repair : found.repairs) {
    if (!repair.harmless) warned.push_back(repair.kind);
  }
  for (const std::string& kind : row.repairs) EXPECT_GT(count_of_kind(found, kind), 0) << kind;
  if (row.repairs.empty()) {
    EXPECT_TRUE(warned.empty()) << warned.front();
    EXPECT_EQ(skin_triangles, mesh.triangles.rows()) << "a sound skin keeps its triangles";
  }
}

TEST_P(SharedMeshes, AreTheSameAtAnyScale) {
  const SurfaceMesh mesh = recentred(read_mesh(file()));
  if (GetParam().solids == 0) return;
  const Solids expected = find_solids(mesh, GetParam().file);
  for (const double scale : {1e-6, 1e6}) {
    SurfaceMesh scaled = mesh;
    scaled.positions *= scale;
    const Solids found = find_solids(scaled, GetParam().file);
    EXPECT_EQ(notes_of(found.repairs), notes_of(expected.repairs));
    ASSERT_EQ(found.solids.size(), expected.solids.size());
    for (std::size_t i = 0; i < found.solids.size(); ++i) {
      EXPECT_EQ(voxelize(found.solids[i], scale * longest_side(mesh) / 16).cells,
                voxelize(expected.solids[i], longest_side(mesh) / 16).cells);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SharedMeshes, ::testing::ValuesIn(rows()), [](const auto& tested) {
  std::string name = tested.param.file;
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
  return name;
});

/// What the mesh's bricks hold above a height, as a share of all.
double volume_above(const BrickGrid& grid, double share_of_height) {
  int top = 0;
  for (const auto& cell : grid.cells) top = std::max(top, cell.y());
  double above = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (grid.cells[i].y() > share_of_height * top) above += grid.fill[i] * grid.brick_volume();
  }
  return above / grid.volume();
}

TEST(SharedScan, EarsAndHeadNeitherFillNorLeak) {
  const auto scan = test::shared_mesh("bun_zipper.ply");
  const auto whole = test::shared_mesh("bunny.obj");
  if (!std::filesystem::exists(scan)) GTEST_SKIP() << "the shared meshes are not here";
  const SurfaceMesh mesh = read_mesh(scan);
  const SurfaceMesh sound = read_mesh(whole);
  const Solids found = find_solids(mesh, "scan");
  EXPECT_EQ(count_of_kind(found, "hole_filled"), 5);
  EXPECT_EQ(count_of_kind(found, "unreferenced"), 1113);
  // The same animal, remeshed without holes.
  const BrickGrid a = voxelize(found.solids.at(0), longest_side(mesh) / 48);
  const BrickGrid b = voxelize(find_solids(sound, "bunny").solids.at(0), longest_side(sound) / 48);
  EXPECT_NEAR(a.volume() / std::pow(longest_side(mesh), 3) / (b.volume() / std::pow(longest_side(sound), 3)), 1, 0.03);
  for (const double height : {0.5, 0.7, 0.85}) {
    EXPECT_NEAR(volume_above(a, height) / volume_above(b, height), 1, 0.1) << height;
  }
}

TEST(SharedHand, WristIsClosedFlat) {
  const auto file = test::shared_mesh("hand_lowres.obj");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared meshes are not here";
  const SurfaceMesh mesh = read_mesh(file);
  const Solid& solid = find_solids(mesh, "hand").solids.at(0);
  EXPECT_EQ(std::count(solid.source.begin(), solid.source.end(), -1), 14) << "16 edges and no point inside";
}

TEST(SharedGears, StayApartAtFineBricks) {
  const auto file = test::shared_mesh("cube_gears.3mf");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared meshes are not here";
  const SurfaceMesh mesh = read_mesh(file);
  const Solids found = find_solids(mesh, "gears");
  ASSERT_EQ(found.solids.size(), 17U);
  double volume = 0;
  for (const Solid& solid : found.solids) volume += voxelize(solid, longest_side(mesh) / 192).volume();
  EXPECT_NEAR(volume / 1.124e5, 1, 2e-3);
}

TEST(SharedLego, IsAShellWhereAThicknessIsGiven) {
  const auto file = test::shared_mesh("lego.ply");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared meshes are not here";
  const Solids found = find_solids(read_mesh(file), "lego", {.thickness = 0.02});
  ASSERT_EQ(found.solids.size(), 1U);
  EXPECT_NEAR(voxelize(found.solids[0], 0.02).volume() / found.solids[0].volume, 1, 0.05);
}

}  // namespace
}  // namespace sprung
