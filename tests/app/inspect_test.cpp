#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "app/inspect/forecast.h"
#include "render/image/png.h"
#include "tests/support/json_number.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

class Inspect : public testing::Test {
 protected:
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, "inspect " + words); }

  TempFolder folder_;
  std::filesystem::path cube_ = folder_.write("cube.obj", kCubeObj);
};

TEST_F(Inspect, SaysWhatAMeshIs) {
  const ProgramRun made = run("cube.obj --bricks 6 --density 1000 --size 10cm --picture cube.png");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* part : {"8 vertices, 12 triangles, 1 part, 1 solid, closed", "216 of ", "343 nodes",
                           "1 connected piece", "1 kg", "stable step", "forecast"}) {
    EXPECT_NE(made.out.find(part), std::string::npos) << part << " in " << made.out;
  }
  EXPECT_EQ(read_png(folder_.path() / "cube.png").width, 1800);
  EXPECT_EQ(made.out.find("warning"), std::string::npos);
  EXPECT_EQ(run("cube.obj --bricks 6 --picture cube.png").exit_code, 2);
}

TEST_F(Inspect, TakesTheUnitOfAFile) {
  const ProgramRun made = run("cube.obj --bricks 6 --unit cm --density 1000 --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("\"unit\": 0.01,"), std::string::npos) << made.out;
  EXPECT_EQ(made.err.find("--unit mm changes it"), std::string::npos) << made.err;
  EXPECT_NE(run("cube.obj --bricks 6 --density 1000").err.find("--size 12cm or --unit mm changes it"),
            std::string::npos);
  EXPECT_NE(run("cube.obj --unit cm --size 1m").err.find("give --unit or --size, not both"), std::string::npos);
  EXPECT_NE(run("cube.obj --scale 1cm --size 1m").err.find("give --size or --scale, not both"), std::string::npos);
  const std::string scaled = run("cube.obj --bricks 6 --scale 1cm --density 1000 --json").out;
  EXPECT_NE(scaled.find("\"unit\": 0.01,"), std::string::npos) << scaled;
  EXPECT_NE(run("cube.obj --unit 2").err.find("no unit of length"), std::string::npos);
}

TEST_F(Inspect, TheSameAsJson) {
  const ProgramRun made = run("cube.obj --bricks 6 --size 10cm --density 1000 --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string& json = made.out;
  EXPECT_EQ(number_at(json, {"mesh", "vertices"}), 8);
  EXPECT_EQ(number_at(json, {"mesh", "triangles"}), 12);
  EXPECT_EQ(number_at(json, {"mesh", "solids"}), 1);
  EXPECT_NE(json.find("\"closed\": true"), std::string::npos);
  EXPECT_NE(json.find("\"repairs\": []"), std::string::npos);
  EXPECT_NEAR(number_at(json, {"mesh", "volume"}), 1, 1e-12);
  EXPECT_EQ(number_at(json, {"bricks", "count"}), 216);
  EXPECT_EQ(number_at(json, {"bricks", "nodes"}), 343);
  EXPECT_EQ(number_at(json, {"bricks", "solids"}), 1);
  EXPECT_NEAR(number_at(json, {"bricks", "size"}), 0.1 / 6, 1e-12);
  EXPECT_NEAR(number_at(json, {"bricks", "volume"}), 1, 1e-9);
  EXPECT_NEAR(number_at(json, {"bricks", "mass"}), 1, 1e-9);
  EXPECT_GT(number_at(json, {"stable_step"}), 0);
  EXPECT_GT(number_at(json, {"forecast", "memory_bytes"}), 1e7);
  EXPECT_GT(number_at(json, {"forecast", "seconds_per_frame"}), 0);
  EXPECT_NE(json.find("\"warnings\": []"), std::string::npos);
}

TEST_F(Inspect, BodiesWithCopiesAreSeenOneByOne) {
  static_cast<void>(folder_.write("scene.toml",
                                  "[[body]]\nmesh = \"cube.obj\"\nsize = 0.1\nbricks = 4\nmaterial = \"gelatin\"\n"
                                  "copies = { count = [3, 1, 1], spacing = [0.2, 0, 0] }\n[[body]]\n"
                                  "mesh = \"cube.obj\"\nsize = 0.05\nbricks = 4\nmaterial = \"gelatin\"\n"
                                  "position = [0, 1, 0]\n"));
  const ProgramRun made = run("scene.toml");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* part : {"1.015 kg", "0.1269 kg"}) EXPECT_NE(made.out.find(part), std::string::npos) << made.out;
}

TEST_F(Inspect, WarnsAsAnimateDoesAndBothOnce) {
  // A plate of a quarter of a brick.
  std::string text = kCubeObj;
  text = std::regex_replace(text, std::regex("(v \\S+ \\S+) 1(\\s)"), "$1 0.02$2");
  static_cast<void>(folder_.write("plate.obj", text));
  const ProgramRun seen = run("plate.obj --bricks 12 --json");
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_NE(seen.out.find("plate.obj: 1 part is thinner than a brick"), std::string::npos) << seen.out;
  const nlohmann::json part = nlohmann::json::parse(seen.out)["bricks"]["thin_parts"][0];
  EXPECT_NEAR(part["thickness_bricks"].get<double>(), 0.24, 0.01);
  EXPECT_NEAR(part["missing_bend_if_curved"].get<double>(), 0.24, 0.01);
  const ProgramRun made = run_program(
      folder_, "animate plate.obj --bricks 12 --duration 0.05 --fps 20 --resolution 160x120 --samples 1 -o out");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto at = made.err.find("is thinner than a brick");
  EXPECT_NE(at, std::string::npos) << made.err;
  EXPECT_EQ(made.err.find("is thinner than a brick", at + 1), std::string::npos) << made.err;
}

/// Statics say it too; a film, whose figures nobody reads, does not.
TEST_F(Inspect, TellsHowMuchTooLittleWallsOfFewBricksBend) {
  std::string text = kCubeObj;
  text = std::regex_replace(text, std::regex("(v \\S+ \\S+) 1(\\s)"), "$1 0.1$2");
  static_cast<void>(folder_.write("plate.obj", text));
  EXPECT_NE(run("plate.obj --bricks 12").out.find("walls       the thinnest 1.2 bricks thick: bend up to 16 %"),
            std::string::npos);
  EXPECT_EQ(run("cube.obj --bricks 8").out.find("walls"), std::string::npos);
  const nlohmann::json walls = nlohmann::json::parse(run("plate.obj --bricks 12 --json").out)["bricks"]["walls"];
  EXPECT_NEAR(walls["thickness_bricks"].get<double>(), 1.2, 0.01);
  EXPECT_NEAR(walls["missing_bend_if_curved"].get<double>(), 0.158, 1e-6);
  const auto simulate = [&](const std::string& scheme) {
    static_cast<void>(folder_.write("scene.toml", "duration = 0.05\nfps = 20\n[solver]\nscheme = \"" + scheme +
                                                      "\"\n[[body]]\nmesh = \"plate.obj\"\nsize = 0.1\nbricks = 12\n"
                                                      "material = \"abs\"\n[[body.pin]]\non_surface = true\n"
                                                      "box = { min = [0, 0, 0], max = [0, 1, 1] }\n"));
    return run_program(folder_, "simulate scene.toml -o out/ --overwrite").err;
  };
  const std::string told = "plate.obj: its thinnest walls, 1 cm, are 1.2 bricks thick: they bend up to 16 % too little";
  EXPECT_NE(simulate("linear").find(told), std::string::npos);
  EXPECT_EQ(simulate("euler").find("thinnest walls"), std::string::npos);
}

TEST_F(Inspect, BricksByThemselves) {
  const ProgramRun made = run("cube.obj --bricks auto --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("bricks: 12 of "), std::string::npos) << made.err;
  EXPECT_EQ(number_at(made.out, {"bricks", "count"}), 12 * 12 * 12);
  static_cast<void>(folder_.write("auto.toml", "[[body]]\nmesh = \"cube.obj\"\nbricks = \"auto\"\n"));
  EXPECT_EQ(number_at(run("auto.toml --json").out, {"bricks", "count"}), 12 * 12 * 12);
  EXPECT_NE(run("auto.toml --print-scene").out.find("bricks = \"auto\""), std::string::npos);
  static_cast<void>(folder_.write("box.toml", "[[body]]\nbox = [1, 1, 1]\nbricks = \"auto\"\n"));
  EXPECT_EQ(run("box.toml").exit_code, 3);
  EXPECT_EQ(run("cube.obj --bricks many").exit_code, 2);
}

TEST_F(Inspect, BadInputIsOneLineAndThree) {
  const ProgramRun ended = run("missing.obj");
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.err.find("sprung: error: "), std::string::npos) << ended.err;
}

TEST_F(Inspect, ForecastsTheFramesOfAFilmThatEndsAtRest) {
  const std::string drop = "cube.obj --bricks 4 --size 10cm --material silicone-a40 ";
  const ProgramRun seen = run(drop + "--json");
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  const ProgramRun made = run_program(folder_, "simulate " + drop + "-o run.h5");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string frames = std::to_string(long(number_at(seen.out, {"forecast", "frames"})));
  const std::string cache = run("run.h5").out;
  EXPECT_NE(cache.find("frames " + frames + " of at most"), std::string::npos) << cache;
}

/// Of a bare mesh for which sprung chooses a material.
TEST_F(Inspect, TellsTheMaterialAndTheSizeThatWereChosenAsSimulateDoes) {
  const nlohmann::json seen = nlohmann::json::parse(run("cube.obj --bricks 4 --json").out);
  const ProgramRun run = run_program(folder_, "simulate cube.obj --bricks 4 --duration 0.05 -o chosen.h5 --json");
  const nlohmann::json made = nlohmann::json::parse(run.out);
  EXPECT_EQ(made["bodies"][0]["material"], seen["bodies"][0]["material"]);
  EXPECT_EQ(made["bodies"][0]["material"]["name"], "gelatin");
  EXPECT_EQ(made["bodies"][0]["material"]["poisson"], 0.499);
  EXPECT_EQ(made["bodies"][0]["material"]["poisson_in_motion"], 0.45);
  EXPECT_EQ(made["bodies"][0]["size_m"], 0.2);
  EXPECT_EQ(made["bodies"][0]["mesh"], "cube.obj");
}

TEST(Forecast, WarnsOfMoreMemoryThanThereIs) {
  EXPECT_EQ(warning_of_memory(1e6), "");
  EXPECT_NE(warning_of_memory(1e18).find("needs about 1e+09 GB of memory"), std::string::npos)
      << warning_of_memory(1e18);
}

}  // namespace
}  // namespace sprung
