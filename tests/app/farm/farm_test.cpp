#include <gtest/gtest.h>

#include "app/farm/sweep.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

const std::string kScene = R"(
fps = 10
duration = 0.4
[render]
resolution = [64, 48]
samples = 1
[[body]]
box = [0.1, 0.1, 0.1]
bricks = 3
[[probe]]
name = "middle"
point = [0, 0, 0]
)";

TEST(StitchFilm, NamesEveryGap) {
  const TempFolder folder;
  static_cast<void>(folder.write("scene.toml", kScene));
  ASSERT_EQ(run_program(folder, "animate scene.toml -o p/ --duration 0.8").exit_code, 0);
  for (const char* name : {"p/frame_0002.png", "p/frame_0004.png", "p/frame_0005.png"}) {
    std::filesystem::remove(folder.path() / name);
  }
  const ProgramRun gaps = run_program(folder, "film p/ -o film.mp4");
  EXPECT_EQ(gaps.exit_code, 3);
  EXPECT_NE(gaps.err.find("missing: 2, 4:5"), std::string::npos) << gaps.err;
  EXPECT_NE(run_program(folder, "film p/ -o film.mp4 --frames 6:10").err.find("missing: 9:10"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "film.mp4"));
  EXPECT_EQ(run_program(folder, "film p/frame_{:04}.png -o film.mp4 --frames 6:8").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "film.mp4"));
  EXPECT_EQ(run_program(folder, "film p/ -o film.mp4 --frames 6:8").exit_code, 2);
  EXPECT_EQ(run_program(folder, "film none/ -o other.mp4").exit_code, 3);
}

TEST(Sweep, RunsEveryCombinationAndGathersTheirProbes) {
  const TempFolder folder;
  static_cast<void>(folder.write("scene.toml", kScene));
  const ProgramRun made = run_program(
      folder, "sweep scene.toml --set body.material=gelatin,rubber --set 'gravity=[0,-9.81,0],[0,0,0]' -o s");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "s/commands\n");
  const std::string runs = text_of(folder.path() / "s/runs.json");
  EXPECT_NE(runs.find("\"folder\": \"004\", \"set\": {\"body.material\": \"rubber\", \"gravity\": \"[0,0,0]\"}"),
            std::string::npos)
      << runs;
  EXPECT_NE(run_program(folder, "sweep s --table").err.find("run 001 is not begun"), std::string::npos);
  const std::string path = std::filesystem::path(SPRUNG_PROGRAM).parent_path().string();
  ASSERT_EQ(std::system(
                ("PATH=" + path + ":$PATH sh " + (folder.path() / "s/commands").string() + " >/dev/null 2>&1").c_str()),
            0);
  const ProgramRun table = run_program(folder, "sweep s --table");
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_EQ(table.out.rfind("run,frames,time_s,state_hash,middle.position.x", 0), 0U) << table.out;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 5);
  EXPECT_NE(table.out.find("\n002,4,0.3,"), std::string::npos) << table.out;
  EXPECT_EQ(run_program(folder, "sweep scene.toml --set body.material=gelatin -o s").exit_code, 2);
  EXPECT_EQ(run_program(folder, "sweep scene.toml --set body.material=gelatin,ruber -o t").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t"));
}

TEST(Sweep, CommasInBracketsDoNotDivide) {
  EXPECT_EQ(values_in("a,b"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(values_in("[0,1,2],[3,4,5]"), (std::vector<std::string>{"[0,1,2]", "[3,4,5]"}));
  EXPECT_EQ(values_in("7"), std::vector<std::string>{"7"});
}

}  // namespace
}  // namespace sprung
