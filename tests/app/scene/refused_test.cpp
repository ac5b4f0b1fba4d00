#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/scene/scene_file.h"
#include "app/scene/scene_reference.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"

/// Mistakes in scenes; schema and reference agree with the parser.
namespace sprung {
namespace {

struct RefusedScene {
  int line = 0;  // of refused.txt
  std::string message;
  std::string text;
};

std::vector<RefusedScene> refused_scenes() {
  std::ifstream file(SPRUNG_SOURCE_DIR "/tests/app/scene/refused.txt");
  std::vector<RefusedScene> scenes;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.starts_with("=== ") || line.starts_with("==! ")) {
      scenes.push_back({number, line.substr(4), ""});
    } else if (!scenes.empty()) {
      scenes.back().text += line + "\n";
    }
  }
  return scenes;
}

TEST(RefusedScenes, AreRefusedInTheseWords) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::vector<RefusedScene> scenes = refused_scenes();
  EXPECT_GT(scenes.size(), 40U);
  for (const RefusedScene& scene : scenes) {
    const std::string mistakes =
        error_message([&] { static_cast<void>(parse_scene(scene.text, folder.path() / "scene.toml")); });
    EXPECT_NE(mistakes.find(scene.message), std::string::npos) << "refused.txt:" << scene.line << ": " << mistakes;
    EXPECT_EQ(std::count(mistakes.begin(), mistakes.end(), '\n'), 0) << "refused.txt:" << scene.line << mistakes;
  }
}

TEST(RefusedScenes, TenMistakesAreTenErrorsInOneRun) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const auto file = folder.write("scene.toml", R"(duration = "3 parsec"
fbs = 24
gravity = [0, -9.81]
[[body]]
mesh = "missing.obj"
bricks = 0
material = "gelatine"
  [[body.pin]]
  box = { min = [0, 0, 0], max = [-1, 1, 1] }
  interpolation = "smoth"
  until = -1
[render]
samples = 3
)");
  const ProgramRun run = run_program(folder, "inspect " + file.string());
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 10) << run.err;
  for (const std::string place : {"1:12: duration", "2:1: unknown key 'fbs'; did you mean 'fps'?", "3:11: gravity",
                                  "5:8: body.mesh", "6:10: body.bricks", "7:12: body.material", "9:9: body.pin.box",
                                  "10:19: body.pin.interpolation", "11:11: body.pin.until", "13:11: render.samples"}) {
    EXPECT_NE(run.err.find("scene.toml:" + place), std::string::npos) << place << "\n" << run.err;
  }
}

TEST(SceneHelp, SchemaAndReferenceInTheTreeAreUpToDate) {
  EXPECT_EQ(text_of(SPRUNG_SOURCE_DIR "/assets/scene.schema.json"), scene_schema())
      << "build/release/sprung help scene --json-schema > assets/scene.schema.json";
  EXPECT_EQ(text_of(SPRUNG_SOURCE_DIR "/assets/scene.md"), scene_reference())
      << "build/release/sprung help scene > assets/scene.md";
}

TEST(SceneHelp, IsPrintedByTheProgram) {
  const TempFolder folder;
  EXPECT_EQ(run_program(folder, "help scene").out, scene_reference());
  EXPECT_EQ(run_program(folder, "help scene --json-schema").out, scene_schema());
  EXPECT_NE(run_program(folder, "help animate").out.find("Usage: sprung animate "), std::string::npos);
  EXPECT_EQ(run_program(folder, "help").out, run_program(folder, "--help").out);
  const ProgramRun wrong = run_program(folder, "help scenes");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("no help on 'scenes'; did you mean 'scene'?"), std::string::npos);
}

}  // namespace
}  // namespace sprung
