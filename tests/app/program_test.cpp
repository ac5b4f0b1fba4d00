#include <gtest/gtest.h>

#include "render/png.h"
#include "tests/support/run_program.h"

/// The built program as a person meets it.
namespace sprung {
namespace {

const std::string kTiny = "animate cube.obj --bricks 6 --duration 1 --fps 4 --resolution 160x120 --samples 1";

class Program : public testing::Test {
 protected:
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, words); }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  /// Runs, and expects an end with one line "sprung: error: ..." that has `part` in it.
  void expect_error(const std::string& words, int exit_code, const std::string& part) const {
    const ProgramRun ended = run(words);
    EXPECT_EQ(ended.exit_code, exit_code) << words << "\n" << ended.err;
    EXPECT_NE(ended.err.find("sprung: error: "), std::string::npos) << words << "\n" << ended.err;
    EXPECT_NE(ended.err.find(part), std::string::npos) << words << "\n" << ended.err;
    EXPECT_EQ(ended.out, "") << words;
  }

  TempFolder folder_;
  std::filesystem::path cube_ = folder_.write("cube.obj", kCubeObj);
};

TEST_F(Program, ShowsItsCommandsHelpAndVersion) {
  const ProgramRun alone = run("");
  EXPECT_EQ(alone.exit_code, 0);
  EXPECT_NE(alone.out.find("animate"), std::string::npos);
  EXPECT_NE(alone.out.find("materials"), std::string::npos);
  EXPECT_NE(run("animate --help").out.find("Young's modulus"), std::string::npos);
  EXPECT_EQ(run("--version").out.rfind("sprung ", 0), 0U);
  const ProgramRun materials = run("materials");
  EXPECT_EQ(materials.exit_code, 0);
  EXPECT_NE(materials.out.find("gelatin"), std::string::npos);
}

TEST_F(Program, WrongUsageIsTwo) {
  expect_error("anmate cube.obj", 2, "unknown command 'anmate'; did you mean 'animate'?");
  expect_error("animate cube.obj --brisks 6 -o out", 2, "unknown option '--brisks'; did you mean '--bricks'?");
  expect_error("animate cube.obj", 2, "needs an output");
  expect_error("animate -o out", 2, "needs a mesh");
  expect_error("animate cube.obj -o out --young '3 parsec'", 2, "--young: '3 parsec'");
  expect_error("animate cube.obj -o out --bricks 2000", 2, "--bricks: 2000 is out of range");
  expect_error("animate cube.obj -o out --bricks 6 --brick-size 1cm", 2, "not both");
  expect_error("animate cube.obj -o out --scenario dorp", 2, "did you mean 'drop'?");
  expect_error("animate cube.obj -o out --model tensil", 2, "did you mean 'tensile'?");
  expect_error("animate cube.obj -o film.avi", 2, "film (.mp4");
  expect_error("animate cube.obj -o out --threads 0", 2, "--threads: 0 is out of range");
}

TEST_F(Program, BadInputIsThree) {
  expect_error("animate missing.obj -o out", 3, "missing.obj");
  expect_error("animate missing.toml -o out", 3, "missing.toml");
  expect_error("animate cube.obj -o out --material gelatine", 3, "did you mean 'gelatin'?");
  static_cast<void>(folder_.write("empty.obj", ""));
  expect_error("animate empty.obj -o out", 3, "empty.obj");
  static_cast<void>(folder_.write("bad.toml", "fbs = 3\n[[body]]\nmesh = \"nothing.obj\"\n"));
  expect_error("animate bad.toml -o out", 3, "sprung: error: bad.toml:1:1: unknown key 'fbs'");
  expect_error("animate bad.toml -o out", 3, "sprung: error: bad.toml:3:8: body.mesh");
  EXPECT_FALSE(exists("out"));
}

TEST_F(Program, NoColourInAFile) {
  EXPECT_EQ(run("animate missing.obj -o out").err.find('\033'), std::string::npos);
  EXPECT_EQ(run(kTiny + " -o out").err.find('\033'), std::string::npos);
}

TEST_F(Program, MakesThePicturesThatWereAskedFor) {
  const ProgramRun made = run(kTiny + " -o out");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "out\n");
  for (int frame = 1; frame <= 4; ++frame) EXPECT_TRUE(exists("out/frame_000" + std::to_string(frame) + ".png"));
  EXPECT_FALSE(exists("out/frame_0005.png"));
  EXPECT_NE(made.err.find("216 bricks"), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("size: cube.obj is 1 file units long"), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("0 inverted bricks"), std::string::npos) << made.err;
  const Image first = read_png(folder_.path() / "out/frame_0001.png");
  const Image last = read_png(folder_.path() / "out/frame_0004.png");
  EXPECT_EQ(first.width, 160);
  EXPECT_EQ(first.height, 120);
  EXPECT_NE(first.pixels, last.pixels);
}

TEST_F(Program, GroundIsRespected) {
  const ProgramRun made = run(kTiny + " -o out");
  const std::string label = "deepest below the ground ";
  const auto at = made.err.find(label);
  ASSERT_NE(at, std::string::npos) << made.err;
  const auto open = made.err.find('(', at);
  EXPECT_LT(std::stod(made.err.substr(open + 1)), 2.0) << made.err;  // percent of the size
}

TEST_F(Program, SameInputSamePictures) {
  ASSERT_EQ(run(kTiny + " -o a --threads 1").exit_code, 0);
  ASSERT_EQ(run(kTiny + " -o b --threads 2").exit_code, 0);
  EXPECT_EQ(text_of(folder_.path() / "a/frame_0004.png"), text_of(folder_.path() / "b/frame_0004.png"));
}

TEST_F(Program, HangsByItsTop) {
  const ProgramRun made = run(kTiny + " --scenario hang -o h_{:02}.png");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(exists("h_04.png"));
}

TEST_F(Program, KeepsWhatExistsUnlessTold) {
  ASSERT_EQ(run(kTiny + " -o out").exit_code, 0);
  expect_error(kTiny + " -o out", 2, "--overwrite");
  ASSERT_EQ(run(kTiny + " -o out --overwrite --duration 0.5").exit_code, 2);  // twice the same option
  const std::string shorter = "animate cube.obj --bricks 6 --duration 0.5 --fps 4 --resolution 160x120 -o out";
  ASSERT_EQ(run(shorter + " --overwrite").exit_code, 0);
  EXPECT_TRUE(exists("out/frame_0002.png"));
  EXPECT_TRUE(exists("out/frame_0003.png"));  // never its own to remove
}

TEST_F(Program, PrintedSceneMakesTheSameFilm) {
  const ProgramRun printed = run(kTiny + " --young 30kPa --print-scene");
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  static_cast<void>(folder_.write("printed.toml", printed.out));
  EXPECT_EQ(run("animate printed.toml --print-scene").out, printed.out);
  ASSERT_EQ(run(kTiny + " --young 30kPa -o a").exit_code, 0);
  ASSERT_EQ(run("animate printed.toml -o b").exit_code, 0);
  EXPECT_EQ(text_of(folder_.path() / "a/frame_0004.png"), text_of(folder_.path() / "b/frame_0004.png"));
}

TEST_F(Program, QuietSaysNothingButResults) {
  const ProgramRun made = run(kTiny + " --quiet -o out");
  EXPECT_EQ(made.exit_code, 0);
  EXPECT_EQ(made.err, "");
  EXPECT_EQ(made.out, "out\n");
}

TEST_F(Program, FilmAndFolderInOneRun) {
  const ProgramRun made = run(kTiny + " -o film.gif -o out/");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "film.gif\nout/\n");
  EXPECT_GT(std::filesystem::file_size(folder_.path() / "film.gif"), 1000U);
  EXPECT_TRUE(exists("out/frame_0004.png"));
}

TEST_F(Program, MissingFfmpegIsSaidBeforeTheWork) {
  const std::string words = kTiny + " -o film.mp4";
  const ProgramRun ended = run_program(folder_, words, "PATH=/nowhere");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("ffmpeg"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("simulate"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace sprung
