#include "core/mesh/io/read_mesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <fstream>

#include "core/error.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for every test, removed afterwards.
class ReadMesh : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] const fs::path& folder() const { return folder_; }

  [[nodiscard]] fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

 private:
  fs::path folder_ =
      fs::temp_directory_path() /
      fmt::format("sprung_read_mesh_{}_{}", getpid(), ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// The message that reading `file` ends with; it must come at once and concern the input.
std::string refusal(const fs::path& file) {
  const auto start = std::chrono::steady_clock::now();
  try {
    (void)read_mesh(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << "the message does not name the file";
    return error.what();
  }
  return "nothing was refused";
}

void expect_refusal(const fs::path& file, const std::string& reason) {
  const std::string message = refusal(file);
  EXPECT_NE(message.find(reason), std::string::npos) << message;
}

constexpr const char* kCubeObj =
    "mtllib cube.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl red\n"
    "f 4/1 3/2 2/3 1/4\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\nf -8/1 -4/2 -1/3 "
    "-5/4\n";

TEST_F(ReadMesh, RefusesWhatIsNoFile) {
  expect_refusal(folder() / "absent.obj", "no such file");
  expect_refusal(folder(), "is a directory");
  expect_refusal(write("empty.stl", ""), "empty file");
  expect_refusal(write("mesh.txt", "hello"), "'.txt' is not a mesh format");
}

TEST_F(ReadMesh, RefusesDamagedFilesByName) {
  expect_refusal(write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"), "face 2 refers to vertex 4 of 3");
  expect_refusal(write("b.obj", "v 0 0 0\nv 1 0 0\nf 1 2 -3\nv 0 1 0\n"), "face 1 refers to vertex -3");
  expect_refusal(write("c.obj", "v 0 0 0\nv 1 1e999 0\nv 0 1 0\nf 1 2 3\n"),
                 "vertex 2 has a coordinate that is not finite");
  expect_refusal(write("d.obj", "v 0 0 0\nv 1 0 0\n"), "no faces (a point cloud); it holds 2 points");
  expect_refusal(write("e.off", "OFF\n999999999999 1 0\n0 0 0\n"), "declares 999999999999 vertices");
  expect_refusal(write("f.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
                 "f.off:6: face 1 refers to vertex 7, but they run from 0 to 2 (index out of range)");
  expect_refusal(write("g.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
                 "vertex 2 has a coordinate that is not finite");
  expect_refusal(write("h.glb", std::string("glTF\2\0\0\0\0\1\0\0JSON", 16)),
                 "file is shorter (16) than its header says (256)");
  expect_refusal(write("i.glb", "not a binary glTF"), "is not a GLB file");
  expect_refusal(write("k.stl", std::string("solid of 1 triangle").append(61, '\0') + std::string("\1\0\0\0cut", 7)),
                 "file is shorter (87) than its header says (134)");
  expect_refusal(write("j.3mf", "PK\3\4 cut"), "the file is cut short");
}

TEST_F(ReadMesh, RefusesEveryPlyCutInsideItsHeader) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\n";
  for (std::size_t length = 4; length < header.size(); length += 7) {
    expect_refusal(write("cut.ply", header.substr(0, length)), "no 'end_header'");
  }
  expect_refusal(write("many.ply",
                       "ply\nformat ascii 1.0\nelement vertex 300000000\nproperty float x\nelement face 1\n"
                       "property list uchar int vertex_indices\nend_header\n0\n"),
                 "declares 300000000 of 'vertex', more than the file can hold");
}

TEST_F(ReadMesh, KeepsUvsMaterialAndTextureOfAnObj) {
  const fs::path file = write("cube.obj", kCubeObj);
  (void)write("cube.mtl", "newmtl red\nKd 0.75 0.5 0.25\nmap_Kd textures\\skin one.png\n");
  fs::create_directories(folder() / "textures");
  (void)write("textures/skin one.png", "picture");
  const SurfaceMesh mesh = read_mesh(file);
  EXPECT_EQ(mesh.triangles.rows(), 12);
  EXPECT_EQ(mesh.uvs.rows(), mesh.positions.rows());
  ASSERT_EQ(mesh.parts.size(), 1U);
  EXPECT_EQ(mesh.parts[0].triangle_count, 12);
  ASSERT_GE(mesh.parts[0].material, 0);
  const SurfaceMaterial& material = mesh.materials.at(mesh.parts[0].material);
  EXPECT_EQ(material.name, "red");
  EXPECT_TRUE(material.color.isApprox(Eigen::Vector4f(0.75F, 0.5F, 0.25F, 1.0F)));
  EXPECT_EQ(material.texture.size(), 7U);
  EXPECT_NEAR(find_solids(mesh, "cube").solids.at(0).volume, 1, 1e-15);
}

TEST_F(ReadMesh, NotesATextureThatIsNotThere) {
  const fs::path file = write("cube.obj", kCubeObj);
  (void)write("cube.mtl", "newmtl red\nKd 1 0 0\nmap_Kd C:\\work\\absent.png\n");
  const SurfaceMesh mesh = read_mesh(file);
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_NE(mesh.notes[0].find("absent.png"), std::string::npos);
  EXPECT_TRUE(mesh.materials.at(mesh.parts[0].material).texture.empty());
}

TEST_F(ReadMesh, NamesTextInUtf16) {
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.off", "a.gltf"}) {
    expect_refusal(write(name, std::string("\xFF\xFEv\0 \0", 6)), "text in UTF-16; save it as UTF-8");
  }
}

TEST_F(ReadMesh, AppliesMirroringNodesToWindingAndNormals) {
  // One tetrahedron, outward, and a node that mirrors and stretches it.
  const fs::path file = write("mirror.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="n"><float_array id="na" count="3">0.6 0.8 0</float_array><technique_common>
<accessor source="#na" count="1" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/>
<p>0 0 2 0 1 0 0 0 1 0 3 0 0 0 3 0 2 0 1 0 2 0 3 0</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="k"><scale>-2 1 1</scale><instance_geometry url="#g"/></node>
<node id="l"><translate>9 0 0</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)");
  const SurfaceMesh mesh = read_mesh(file);
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_EQ(mesh.parts[1].first_triangle, 4);
  const Solids found = find_solids(mesh, "mirror");
  ASSERT_EQ(found.solids.size(), 2U);
  EXPECT_TRUE(notes_of(found.repairs).empty()) << "the mirrored instance is inside out";
  EXPECT_NEAR(found.solids[0].volume, 2.0 / 6, 1e-6);
  // The plane x = 0.6, y = 0.8 stretched by -2 along x keeps (0.6 / -2, 0.8) as its normal.
  const Eigen::Vector3f expected = Eigen::Vector3f(-0.3F, 0.8F, 0).normalized();
  EXPECT_TRUE(mesh.normals.row(0).transpose().isApprox(expected, 1e-5F)) << mesh.normals.row(0);
}

/// A binary PLY of a tetrahedron with colours, whose first coordinate is the float of these bits.
std::string binary_ply(std::uint32_t first) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n";
  const auto put = [&](std::uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xFF);
  };
  const float corners[4][3]{{std::bit_cast<float>(first), 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& corner : corners) {
    for (const float coordinate : corner) put(std::bit_cast<std::uint32_t>(coordinate));
    bytes += "\xFF\x80";
    bytes += '\0';
  }
  const std::uint32_t faces[4][3]{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  for (const auto& face : faces) {
    bytes += '\3';
    for (const std::uint32_t corner : face) put(corner);
  }
  return bytes;
}

TEST_F(ReadMesh, ReadsBinaryPlyWhateverItsFirstByte) {
  for (const std::uint32_t low : {0x00U, 0x0AU, 0x0DU, 0x20U}) {
    const std::uint32_t first = 0xBF000000U | low;  // about -0.5
    const SurfaceMesh mesh = read_mesh(write("tetrahedron.ply", binary_ply(first)));
    ASSERT_EQ(mesh.triangles.rows(), 4) << low;
    EXPECT_EQ(mesh.positions(0, 0), double(std::bit_cast<float>(first)));
    ASSERT_EQ(mesh.colors.rows(), 4);
    EXPECT_TRUE(mesh.colors.row(0).isApprox(Eigen::RowVector4f(1, 128.0F / 255, 0, 1), 1e-6F)) << mesh.colors.row(0);
    EXPECT_EQ(find_solids(mesh, "tetrahedron").solids.size(), 1U);
  }
}

TEST_F(ReadMesh, CutsHollowPolygonsWithoutLeavingThem) {
  // An arrowhead prism: its end caps are not convex, and a fan from their first corner would leave them.
  const SurfaceMesh mesh = read_mesh(write("arrow.off",
                                           "OFF\n8 6 0\n0 0 0\n2 -1 0\n0.5 0 0\n2 1 0\n0 0 1\n2 -1 1\n0.5 0 1\n2 1 1\n"
                                           "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"));
  EXPECT_EQ(mesh.triangles.rows(), 12);
  double area = 0;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    const Vec3 a = mesh.positions.row(mesh.triangles(t, 0));
    const Vec3 b = mesh.positions.row(mesh.triangles(t, 1));
    const Vec3 c = mesh.positions.row(mesh.triangles(t, 2));
    if (a.z() == b.z() && b.z() == c.z()) area += 0.5 * (b - a).cross(c - a).norm();
  }
  EXPECT_NEAR(area, 2 * 0.5, 1e-12) << "the caps' triangles overlap";
  EXPECT_NEAR(find_solids(mesh, "arrow").solids.at(0).volume, 0.5, 1e-12);
}

/// A zip archive of one file that is not compressed.
std::string archive_of(const std::string& name, const std::string& text) {
  const auto number = [](std::size_t value, int bytes) {
    std::string digits;
    for (int i = 0; i < bytes; ++i) digits += char(value >> (8 * i) & 0xFF);
    return digits;
  };
  const std::string sizes = number(0, 4) + number(text.size(), 4) + number(text.size(), 4) + number(name.size(), 2);
  const std::string entry = "PK\3\4" + number(20, 2) + number(0, 8) + sizes + number(0, 2) + name + text;
  const std::string directory = "PK\1\2" + number(20, 2) + number(20, 2) + number(0, 8) + sizes + number(0, 16) + name;
  return entry + directory + "PK\5\6" + number(0, 18);
}

TEST(StatedUnit, IsWhatTheFileSays) {
  const TempFolder folder;
  const auto unit_of = [&](const std::string& tag) {
    return stated_unit(folder.write("part.3mf", archive_of("3D/part.model", "<?xml version='1.0'?>\n" + tag)));
  };
  EXPECT_EQ(unit_of("<model xml:lang='en' unit=\"inch\">"), "in");
  EXPECT_EQ(unit_of("<model unit='micron'>"), "um");
  EXPECT_EQ(unit_of("<model><metadata name=\"unit\">foot</metadata>"), "mm");
  EXPECT_EQ(stated_unit(folder.write("cut.3mf", "PK\3\4")), "");
  EXPECT_EQ(stated_unit("part.glb"), "m");
  EXPECT_EQ(stated_unit("part.stl"), "");
}

}  // namespace
}  // namespace sprung
