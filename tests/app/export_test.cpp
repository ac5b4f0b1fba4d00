#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
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
  EXPECT_NE(page.find("const films = [{\"name\":\"run\",\"frames\":4,\"fps\":10.0,"), std::string::npos);
  EXPECT_NE(page.find("Permission is hereby granted"), std::string::npos) << "the licence of three.js";
  for (const char* needs : {"<script src", "<link", "<!--"}) EXPECT_EQ(page.find(needs), std::string::npos) << needs;
  EXPECT_TRUE(exists("run.xdmf.h5"));
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder_.path())) {
    EXPECT_EQ(file.path().string().find(".passing"), std::string::npos) << file.path();
  }
}

/// The films of a page, as its script has them.
nlohmann::json films_of(const std::string& page) {
  const std::string_view begins = "const films = ";
  const std::size_t begin = page.find(begins) + begins.size();
  return nlohmann::json::parse(page.substr(begin, page.find(";\n</script>", begin) - begin));
}

std::size_t bytes_in(const nlohmann::json& base64) {
  const auto& text = base64.get_ref<const std::string&>();
  return text.size() / 4 * 3 - std::size_t(std::count(text.end() - 2, text.end(), '='));
}

TEST_F(Export, MakesAPageOfSeveralTakesWithFieldsBricksAndObstacles) {
  static_cast<void>(folder_.write("plate.toml", text_of(folder_.path() / "scene.toml") + R"(
[[obstacle]]
box = [0.3, 0.02, 0.3]
position = [0, 0.5, 0]
keyframes = [{ t = 0 }, { t = 0.4, translate = [0, -0.1, 0] }]
[[obstacle]]
sphere = { radius = 0.05 }
position = [0.5, 0.05, 0]
)"));
  ASSERT_EQ(run("simulate plate.toml -o soft.h5").exit_code, 0);
  ASSERT_EQ(run("simulate scene.toml -o 2.h5 --set body.material.young=90kPa --duration 0.6").exit_code, 0);
  const ProgramRun both = run("export soft.h5 2.h5 -o takes.html --frames 2::2");
  ASSERT_EQ(both.exit_code, 0) << both.err;
  const std::string page = text_of(folder_.path() / "takes.html");
  EXPECT_LT(page.find("const films"), 3U << 20) << "the scripts";
  const nlohmann::json films = films_of(page);
  ASSERT_EQ(films.size(), 2U);
  EXPECT_EQ(films[0]["name"], "soft");
  EXPECT_EQ(films[1]["name"], "2");
  EXPECT_EQ(films[0]["frames"], 2) << "of 4: 2 and 4";
  EXPECT_EQ(films[1]["frames"], 3);
  EXPECT_EQ(films[0]["first_frame"], 2);
  EXPECT_EQ(films[0]["fps"], 5);
  EXPECT_EQ(films[0]["ground"], 0);
  const nlohmann::json& film = films[0];
  ASSERT_EQ(film["meshes"].size(), 3U) << "a cube and two obstacles";
  EXPECT_EQ(bytes_in(film["meshes"][0]["brick"]), 8U * 4);
  EXPECT_EQ(bytes_in(film["meshes"][0]["local"]), 8U * 3 * 4);
  EXPECT_EQ(bytes_in(film["meshes"][1]["obstacle"]) % (2 * 3 * 2), 0U) << "moves";
  EXPECT_LT(bytes_in(film["meshes"][1]["obstacle"]), bytes_in(film["meshes"][2]["obstacle"])) << "a ball, once";
  const std::size_t nodes = 6 * 6 * 6;
  EXPECT_EQ(bytes_in(film["nodes"]), 2 * nodes * 3 * 2);
  EXPECT_EQ(bytes_in(film["bricks"]), 125U * 8 * 4);
  EXPECT_EQ(bytes_in(film["edges"]), 3U * 5 * 6 * 6 * 8);
  ASSERT_EQ(film["fields"].size(), 4U);
  EXPECT_EQ(film["fields"][3]["title"].get<std::string>().substr(0, 7), "Stress,");
  for (const auto& field : film["fields"]) {
    EXPECT_EQ(bytes_in(field["steps"]), 2 * nodes);
    EXPECT_LT(field["low"], field["high"]);
  }
  EXPECT_GT(bytes_in(film["springs"]["pairs"]), bytes_in(film["edges"]));
  EXPECT_EQ(bytes_in(film["springs"]["rest"]) * 2, bytes_in(film["springs"]["pairs"]));
}

TEST_F(Export, RefusesTakesOfWhatHoldsOneFilm) {
  ASSERT_EQ(run("simulate scene.toml -o a.h5").exit_code, 0);
  EXPECT_NE(run("export a.h5 a.h5 -o film.glb").err.find("film.glb holds one film"), std::string::npos);
  EXPECT_NE(run("export scene.toml a.h5 -o film.html").err.find("takes of one page are caches"), std::string::npos);
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
  EXPECT_NE(run("export scene.toml -o skin_{}.ply --quantize").err.find("applies to an animated .glb"),
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
