#include <gtest/gtest.h>

#include "app/sweep/swept_values.h"
#include "core/error.h"
#include "tests/support/json_number.h"
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
  for (const char* part : {R"("folder": "004")", R"("body.material": "rubber")", R"("gravity": "[0,0,0]")"}) {
    EXPECT_NE(runs.find(part, runs.find("003")), std::string::npos) << runs;
  }
  EXPECT_NE(run_program(folder, "sweep s --table").err.find("run 001 is not begun"), std::string::npos);
  const std::string path = std::filesystem::path(SPRUNG_PROGRAM).parent_path().string();
  const std::string line = "PATH=" + path + ":$PATH sh " + (folder.path() / "s/run").string() + " >/dev/null 2>&1";
  ASSERT_EQ(std::system(line.c_str()), 0);
  const ProgramRun table = run_program(folder, "sweep s --table");
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_EQ(table.out.rfind("run,body.material,gravity_m/s2,frames,seconds,time_s,state_hash,middle.position.x_m,", 0),
            0U)
      << table.out;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 5);
  double seconds = 0;
  double time = 0;
  const std::string second = table.out.substr(table.out.find("\n002,"));
  ASSERT_EQ(std::sscanf(second.c_str(), "\n002,gelatin,\"[0,0,0]\",4,%lf,%lf,", &seconds, &time), 2) << table.out;
  EXPECT_GT(seconds, 0);
  EXPECT_EQ(time, 0.3);
  EXPECT_EQ(table.out, text_of(folder.path() / "s/table.csv"));
  const std::string manifest = text_of(folder.path() / "s/002/manifest.json");
  EXPECT_NEAR(number_at(manifest, {"seconds"}), seconds, 1e-9) << manifest;
  EXPECT_EQ(number_at(manifest, {"frames"}), 4);
  EXPECT_NE(manifest.find("\"scene\": \"duration = 0.4"), std::string::npos) << manifest;
  const std::string hash = second.substr(second.find(",0.3,") + 5, 16);
  EXPECT_NE(manifest.find("\"state_hash\": \"" + hash + '"'), std::string::npos) << manifest;
  EXPECT_EQ(run_program(folder, "sweep scene.toml --set body.material=gelatin -o s").exit_code, 2);
  EXPECT_EQ(run_program(folder, "sweep scene.toml --set body.material=gelatin,ruber -o t").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "t"));
}

TEST(Sweep, CommasInBracketsDoNotDivide) {
  EXPECT_EQ(values_in("a,b"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(values_in("[0,1,2],[3,4,5]"), (std::vector<std::string>{"[0,1,2]", "[3,4,5]"}));
  EXPECT_EQ(values_in("7"), std::vector<std::string>{"7"});
}

TEST(Sweep, RangesStandForTheirValues) {
  EXPECT_EQ(values_in("10:40:10"), (std::vector<std::string>{"10", "20", "30", "40"}));
  EXPECT_EQ(values_in("5kPa,0.1kPa:0.3kPa:0.1kPa"), (std::vector<std::string>{"5kPa", "0.1kPa", "0.2kPa", "0.3kPa"}));
  EXPECT_EQ(values_in("3:1:-1"), (std::vector<std::string>{"3", "2", "1"}));
  EXPECT_EQ(values_in("a:b:c"), std::vector<std::string>{"a:b:c"});
  EXPECT_EQ(values_in("1kPa:2Pa:1kPa"),
            std::vector<std::string>{"1kPa:2Pa:1kPa"});  // not a value of any key: refused there
  for (const char* endless : {"1:3:0", "1:3:-1", "0:1:1e-9"}) EXPECT_THROW(values_in(endless), Error) << endless;
}

TEST(Sweep, PlotsAMeasurementOverAKey) {
  const TempFolder folder;
  static_cast<void>(folder.write("scene.toml", kScene));
  ASSERT_EQ(
      run_program(folder, "sweep scene.toml --set body.material.young=10kPa:30kPa:10kPa --set body.bricks=2,3 -o s")
          .exit_code,
      0);
  const std::string path = std::filesystem::path(SPRUNG_PROGRAM).parent_path().string();
  const std::string line = "PATH=" + path + ":$PATH sh " + (folder.path() / "s/commands").string() + " >/dev/null 2>&1";
  ASSERT_EQ(std::system(line.c_str()), 0);
  const std::string table = run_program(folder, "sweep s --table").out;
  EXPECT_EQ(table.rfind("run,body.material.young_Pa,body.bricks,frames,", 0), 0U) << table;
  EXPECT_NE(table.find("\n003,20000,2,4,"), std::string::npos) << table;
  const ProgramRun plot = run_program(folder, "sweep s --plot middle.position.y -o p/plot.svg -o p/plot.html");
  EXPECT_EQ(plot.exit_code, 0) << plot.err;
  for (const char* file : {"p/plot.svg", "p/plot.html"}) {
    const std::string text = text_of(folder.path() / file);
    for (const char* words :
         {"middle.position.y (m)", "body.material.young (Pa)", "body.bricks = 2", "body.bricks = 3"}) {
      EXPECT_NE(text.find(words), std::string::npos) << file << ": " << words;
    }
  }
  EXPECT_EQ(run_program(folder, "sweep s --plot middle.position.y --against body.bricks -o q.svg").exit_code, 0);
  EXPECT_NE(text_of(folder.path() / "q.svg").find("body.material.young = 30000 Pa"), std::string::npos);
  const ProgramRun unknown = run_program(folder, "sweep s --plot midle.position.y -o r.svg");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("middle.position.y"), std::string::npos) << unknown.err;
  EXPECT_EQ(run_program(folder, "sweep s --plot middle.position.y -o r.png").exit_code, 2);
}

}  // namespace
}  // namespace sprung
