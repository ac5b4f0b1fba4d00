#include <gtest/gtest.h>

#include <set>

#include "core/mesh/io/read_mesh.h"
#include "tests/support/running_program.h"

namespace sprung {
namespace {

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

class Export : public testing::Test {
 protected:
  Export() {
    static_cast<void>(folder_.write("cube.obj", kCubeObj));
    static_cast<void>(folder_.write("scene.toml", R"(
fps = 10
duration = 0.4
[[obstacle]]
plane = { y = 0 }
[[body]]
mesh = "cube.obj"
size = 0.2
bricks = 5
position = [0, 0.1, 0]
rotation = [0, 20, 0]
)"));
  }
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, words); }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  TempFolder folder_;
};

TEST_F(Export, KeepsTheMeshOfTheFileAndWritesTheSameFromACacheAndAScene) {
  ASSERT_EQ(run("simulate scene.toml -o run.h5").exit_code, 0);
  const ProgramRun cached = run("export run.h5 -o a/skin_{:03}.obj -o film.glb -o film.html -o points.pc2 -o run.xdmf");
  ASSERT_EQ(cached.exit_code, 0) << cached.err;
  ASSERT_EQ(run("export scene.toml -o b/skin_{:03}.obj --frames 2:4").exit_code, 0);
  EXPECT_FALSE(exists("b/skin_001.obj"));
  for (const char* name : {"skin_002.obj", "skin_004.obj"}) {
    EXPECT_EQ(text_of(folder_.path() / "a" / name), text_of(folder_.path() / "b" / name));
  }
  const SurfaceMesh first = read_mesh(folder_.path() / "a/skin_001.obj");
  const SurfaceMesh cube = read_mesh(folder_.path() / "cube.obj");
  ASSERT_EQ(first.positions.rows(), 8);
  EXPECT_EQ(first.triangles, cube.triangles);
  // At rest it is the cube, smaller, turned and moved.
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      EXPECT_NEAR((first.positions.row(i) - first.positions.row(j)).norm(),
                  0.2 * (cube.positions.row(i) - cube.positions.row(j)).norm(), 1e-6);
    }
  }
  EXPECT_NEAR(first.positions.col(1).minCoeff(), 0.1, 1e-6);
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "points.pc2"), 32U + 4 * 8 * 12);
  const ProgramRun quantized = run("export run.h5 -o quantized.glb --quantize");
  EXPECT_NE(quantized.err.find("quantized.glb: coordinates are off by at most 0.00"), std::string::npos);
  EXPECT_LT(std::filesystem::file_size(folder_.path() / "quantized.glb"),
            std::filesystem::file_size(folder_.path() / "film.glb"));
  const std::string page = text_of(folder_.path() / "film.html");
  EXPECT_NE(page.find("const film = {\"frames\": 4, \"fps\": 10,"), std::string::npos);
  const std::size_t positions = page.find("\"positions\": [\"") + 15;
  EXPECT_EQ(page.find('"', positions) - positions, 4U * 8 * 3 * 2 / 3 * 4) << "four frames of eight vertices, base64";
  EXPECT_NE(page.find("Permission is hereby granted"), std::string::npos) << "the licence of three.js";
  for (const char* needs : {"<script src", "<link", "<!--"}) EXPECT_EQ(page.find(needs), std::string::npos) << needs;
  EXPECT_TRUE(exists("run.xdmf.h5"));
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder_.path())) {
    EXPECT_EQ(file.path().string().find(".passing"), std::string::npos) << file.path();
  }
}

TEST_F(Export, ClearsWhatAKilledExportLeft) {
  const std::string left = "points.pc2.passing.h5";
  {
    RunningProgram program(folder_, {"export", "cube.obj", "--bricks", "6", "--duration", "60", "-o", "points.pc2"});
    ASSERT_TRUE(program.wait_for(folder_.path() / left));
    program.signal(SIGKILL);
    EXPECT_EQ(program.wait().exit_code, -1);
  }
  ASSERT_TRUE(exists(left));
  EXPECT_FALSE(exists("points.pc2"));
  static_cast<void>(folder_.write(left + ".partial", "of one killed before its first frame"));
  const ProgramRun next = run("export scene.toml -o points.pc2");
  EXPECT_EQ(next.exit_code, 0) << next.err;
  EXPECT_EQ(names_in(folder_.path()),
            (std::set<std::string>{"cube.obj", "points.pc2", "program.err", "program.out", "scene.toml"}));
}

TEST_F(Export, SaysWhatCannotBe) {
  EXPECT_NE(run("export scene.toml -o skin.obj").err.find("cannot hold 4 frames"), std::string::npos);
  EXPECT_NE(run("export scene.toml -o skin_{}.obk").err.find("no format"), std::string::npos);
  EXPECT_NE(run("export scene.toml -o skin_{}.ply --quantize").err.find("is about an animated .glb"),
            std::string::npos);
  EXPECT_NE(run("export scene.toml -o film.glp").err.find("did you mean '.glb'?"), std::string::npos);
  static_cast<void>(folder_.write("skin_2.ply", ""));
  EXPECT_EQ(run("export scene.toml -o skin_{}.ply").exit_code, 2);
  const ProgramRun list = run("export --list");
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.out.find("fbx (binary)"), std::string::npos);
  EXPECT_NE(list.out.find(".stl    STL, binary, triangles only; keeps nothing else"), std::string::npos) << list.out;
}

TEST_F(Export, NamesWhatAFormatLoses) {
  std::string cube = "vt 0 0\nvt 1 1\n" + kCubeObj;
  std::size_t corner = cube.find("f ");
  for (; corner < cube.size(); ++corner) {
    if (std::isdigit(cube[corner]) == 0) continue;
    cube.insert(corner + 1, "/1");
    corner += 2;
  }
  static_cast<void>(folder_.write("cube.obj", cube));
  EXPECT_NE(run("export scene.toml --frames 1 -o skin_{}.stl").err.find(".stl files do not keep: UVs"),
            std::string::npos);
  EXPECT_EQ(run("export scene.toml --frames 1 -o skin_{}.ply").err.find("do not keep"), std::string::npos);
}

}  // namespace
}  // namespace sprung
