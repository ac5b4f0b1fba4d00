#include "core/io/mesh_export.h"

#include <gtest/gtest.h>

#include "core/io/animation.h"
#include "core/io/xdmf.h"
#include "core/mesh/io/read_mesh.h"
#include "tests/support/bodies.h"
#include "tests/support/json_number.h"
#include "tests/support/meshes.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// A grid of n x n vertices with everything that a mesh can have, two parts of two materials; and two coincident
/// vertices, which no writer may merge.
Skin sheet(int n) {
  Skin skin;
  const auto count = Eigen::Index(n) * n;
  skin.positions.resize(count, 3);
  skin.normals.resize(count, 3);
  skin.uvs.resize(count, 2);
  skin.triangles.resize(2 * (n - 1) * (n - 1), 3);
  int next = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Eigen::Index row = i * n + j;
      skin.positions.row(row) << j, i, std::sin(i + 2.0 * j);
      skin.uvs.row(row) << float(j) / float(n), float(i) / float(n);
      if (i == 0 || j == 0) continue;
      skin.triangles.row(next++) << i * n + j, i * n + j - n, i * n + j - 1;
      skin.triangles.row(next++) << i * n + j - 1, i * n + j - n, i * n + j - n - 1;
    }
  }
  skin.positions.row(1) = skin.positions.row(0);
  skin.normals = Points::Random(count, 3).rowwise().normalized();
  const int half = int(skin.triangles.rows()) / 2;
  skin.parts = {{.name = "front", .first_triangle = 0, .triangle_count = half, .material = 0},
                {.name = "back", .first_triangle = half, .triangle_count = half, .material = 1}};
  skin.materials = {{.name = "red", .color = {0.8F, 0.1F, 0.2F, 1}, .texture = {}, .texture_name = ""},
                    {.name = "blue", .color = {0.1F, 0.2F, 0.7F, 1}, .texture = {}, .texture_name = ""}};
  return skin;
}

PosedMesh posed(const Skin& skin) {
  PosedMesh mesh;
  mesh.name = "sheet";
  mesh.rest = &skin;
  mesh.positions = skin.positions * 0.37;
  mesh.normals = skin.normals;
  return mesh;
}

/// Corner by corner of the triangles in their order: how the writer numbers vertices does not matter to that.
Points corners_of(const Points& positions, const Triangles& triangles) {
  Points corners(triangles.size(), 3);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) corners.row(i) = positions.row(triangles.data()[i]);
  return corners;
}

class MeshExport : public testing::TestWithParam<MeshFormat> {};

TEST_P(MeshExport, ComesBackAsItWas) {
  const TempFolder folder;
  const Skin skin = sheet(7);
  const PosedMesh mesh = posed(skin);
  const auto file = folder.path() / ("sheet" + std::string(GetParam().extension));
  export_meshes({mesh}, file);
  const SurfaceMesh read = read_mesh(file);
  ASSERT_EQ(read.triangles.rows(), skin.triangles.rows());
  const Points expected = corners_of(mesh.positions, skin.triangles);
  const Points found = corners_of(read.positions, read.triangles);
  EXPECT_LT((expected - found).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
  if (GetParam().extension == ".stl") return;
  // Every frame has as many vertices, whichever positions coincide in it.
  PosedMesh flat = mesh;
  flat.positions.col(0).setZero();
  flat.positions.col(2).setZero();
  const auto other = folder.path() / ("flat" + std::string(GetParam().extension));
  export_meshes({flat}, other);
  EXPECT_EQ(text_of(other).empty(), false);
  const auto count_in = [](const std::filesystem::path& path) { return read_mesh(path).positions.rows(); };
  EXPECT_EQ(count_in(file), count_in(other));
  if (GetParam().extension == ".ply") return;
  ASSERT_EQ(read.parts.size(), 2U);
  EXPECT_EQ(read.parts[0].triangle_count, skin.parts[0].triangle_count);
  ASSERT_GE(read.parts[1].material, 0);
  const Eigen::Vector4f color = read.materials[read.parts[1].material].color;
  EXPECT_LT((color - skin.materials[1].color).cwiseAbs().maxCoeff(), 0.01F) << color.transpose();
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshExport, testing::ValuesIn(mesh_formats().begin(), mesh_formats().end()),
                         [](const auto& test) { return "ending_" + std::string(test.param.extension.substr(1)); });

TEST(MeshExports, ObjKeepsVerticesUvsAndNames) {
  const TempFolder folder;
  const Skin skin = sheet(5);
  const PosedMesh mesh = posed(skin);
  export_meshes({mesh}, folder.path() / "a.obj");
  const SurfaceMesh read = read_mesh(folder.path() / "a.obj");
  EXPECT_EQ(read.parts.at(0).name, "front");
  ASSERT_EQ(read.uvs.rows(), read.positions.rows());
  const std::string text = text_of(folder.path() / "a.obj");
  EXPECT_NE(text.find("\nv 0.74 0 -0.280016923\n"), std::string::npos) << text.substr(0, 300);
  EXPECT_NE(text_of(folder.path() / "a.mtl").find("newmtl sheet_red\nKd 0.8 0.1 0.2\n"), std::string::npos);
}

TEST(MeshExports, ABodysColorIsForWhatHasNone) {
  Skin skin = sheet(3);
  PosedMesh mesh = posed(skin);
  mesh.color = {0.9F, 0.1F, 0.1F};
  EXPECT_EQ(parts_of(mesh)[0].color, skin.materials[0].color);
  skin.parts.clear();
  EXPECT_EQ(parts_of(mesh).at(0).color, Eigen::Vector4f(0.9F, 0.1F, 0.1F, 1));
  skin.colors = Floats4::Constant(9, 4, 0.5F);
  EXPECT_EQ(parts_of(mesh).at(0).color, Eigen::Vector4f::Ones());
}

TEST(PointCaches, AreWhatTheirFormatsSay) {
  const TempFolder folder;
  const std::vector<Floats3> frames{Floats3::Constant(4, 3, 1.5F), Floats3::Constant(4, 3, -2)};
  write_pc2(frames, folder.path() / "a.pc2");
  const std::string pc2 = text_of(folder.path() / "a.pc2");
  ASSERT_EQ(pc2.size(), 32U + 2 * 48);
  EXPECT_EQ(pc2.substr(0, 12), std::string("POINTCACHE2\0", 12));
  float value = 0;
  std::memcpy(&value, &pc2[32 + 48], 4);
  EXPECT_EQ(value, -2);
  write_mdd(frames, std::vector<double>{0, 0.25}, folder.path() / "a.mdd");
  const std::string mdd = text_of(folder.path() / "a.mdd");
  ASSERT_EQ(mdd.size(), 8U + 8 + 2 * 48);
  EXPECT_EQ(mdd.substr(0, 8), std::string("\0\0\0\2\0\0\0\4", 8));
  EXPECT_EQ(mdd.substr(12, 4), std::string("\x3e\x80\0\0", 4));  // 0.25
  EXPECT_EQ(mdd.substr(16 + 48, 4), std::string("\xc0\0\0\0", 4));
}

TEST(AnimatedGlb, HasATargetForEveryLaterFrame) {
  const TempFolder folder;
  const Skin skin = sheet(5);
  AnimatedMesh film{.first = posed(skin), .positions = {}, .normals = {}};
  for (int frame = 0; frame < 4; ++frame) {
    film.positions.emplace_back((film.first.positions.array() + 0.1 * frame).matrix().cast<float>());
    film.normals.emplace_back(film.first.normals.cast<float>());
  }
  write_animated_glb({film}, {1, 1.5, 2, 2.5}, folder.path() / "film.glb");
  const std::string bytes = text_of(folder.path() / "film.glb");
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(bytes.size() % 4, 0U);
  EXPECT_NE(bytes.find("\"weights\":[0,0,0]"), std::string::npos);
  EXPECT_NE(bytes.find("\"path\":\"weights\""), std::string::npos);
  EXPECT_NE(bytes.find("\"min\":[0.0],\"max\":[1.5]"), std::string::npos);
  const SurfaceMesh first = read_mesh(folder.path() / "film.glb");
  EXPECT_EQ(first.positions.rows(), 2 * skin.positions.rows()) << "shared by the two parts";
  EXPECT_LT((corners_of(first.positions, first.triangles) - corners_of(film.first.positions, skin.triangles))
                .cwiseAbs()
                .maxCoeff(),
            1e-6);
}

TEST(Xdmf, NamesWhatIsInItsFileOfNumbers) {
  const TempFolder folder;
  World world;
  world.bodies.emplace_back(make_body(make_box_grid({2, 1, 1}, 0.1), Model::kCalibrated, test::test_material(0.3)));
  const Points rest = world.bodies[0].rest_positions;
  Points stretched = rest;
  stretched.col(0) *= 1.1;
  SoftBody& body = world.bodies[0];
  body.drawn.skin.positions = rest.topRows(3);
  body.drawn.skin.triangles = Triangles{{0, 1, 2}};
  body.drawn.embedding = embed(body.grid, body.drawn.skin.positions);
  XdmfWriter writer(folder.path() / "run.xdmf", world, {{0, 3}});
  const Points still = Points::Zero(rest.rows(), 3);
  writer.add_frame(0, {rest}, {still});
  writer.add_frame(0.5, {stretched}, {(stretched - rest) * 2});
  writer.close();
  const Hdf5Reader numbers(folder.path() / "run.xdmf.h5");
  EXPECT_EQ(numbers.read<int>("/bricks_1/region").values, (std::vector<int>{0, 3}));
  EXPECT_NEAR(numbers.read<float>("/frame_1/bricks_1/stretch").values.at(1), 1, 1e-6);
  EXPECT_NEAR(numbers.read<float>("/frame_2/bricks_1/stretch").values.at(1), 1.1, 1e-6);
  const double stress = world.bodies[0].material.shear_modulus() * (1.1 * 1.1 - 1) / 1.1;  // xx - yy, neo-Hookean
  EXPECT_NEAR(numbers.read<float>("/frame_2/bricks_1/stress").values.at(0), stress, 1e-4 * stress);
  EXPECT_NEAR(numbers.read<float>("/frame_2/skin_1/positions").values.at(3), 1.1 * rest(1, 0), 1e-7);
  const std::vector<float> velocity = numbers.read<float>("/frame_2/bricks_1/velocity").values;
  EXPECT_LT((Eigen::Map<const Floats3>(velocity.data(), rest.rows(), 3).cast<double>() - (stretched - rest) * 2)
                .cwiseAbs()
                .maxCoeff(),
            1e-7);
  const std::vector<float> tensor = numbers.read<float>("/frame_2/bricks_1/stress_tensor").values;
  EXPECT_NEAR(tensor.at(0) - tensor.at(3), stress, 1e-4 * stress);  // xx - yy, of the first node
  EXPECT_NEAR(tensor.at(3) - tensor.at(5), 0, 1e-4 * stress);       // yy - zz
  EXPECT_NEAR(tensor.at(1), 0, 1e-4 * stress);
  const std::string text = text_of(folder.path() / "run.xdmf");
  std::size_t index = 0;
  int items = 0;
  while ((index = text.find("run.xdmf.h5:", index)) != std::string::npos) {
    index += 12;
    EXPECT_TRUE(numbers.has(text.substr(index, text.find('<', index) - index)));
    ++items;
  }
  EXPECT_EQ(items, 2 * (2 + 5 + 2 + 2));
}

}  // namespace
}  // namespace sprung
