#include <gtest/gtest.h>

#include "render/image/png.h"
#include "tests/support/run_program.h"

/// The built program as a user sees it.
namespace sprung {
namespace {

const std::string kTiny = "animate cube.obj --bricks 6 --duration 1 --fps 4 --resolution 160x120 --samples 1";

class Program : public testing::Test {
 protected:
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, words); }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  /// Runs, and expects it to end with one line "sprung: error: ..." that has `part` in it.
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
  expect_error("animate cube.obj -o out --material gelatine", 2, "did you mean 'gelatin'?");
  expect_error("animate cube.obj -o out --texture none.png", 2, "no such file");
  expect_error("animate cube.obj -o out --fps 3 --fps 4", 2, "--fps is given 2 times");
  expect_error("animate cube.obj -o out --poisson 0.3 --poisson 0.4", 2, "--poisson is given 2 times");
  expect_error("animate cube.obj -o out --up", 2, "--up needs a value");
  expect_error("animate cube.obj -o out --fps", 2, "--fps needs a value");
  expect_error("animate cube.obj -o film.mp5", 2, "did you mean '.mp4'?");
  expect_error("animate cube.obj -o out -o ./out/frame_{:04}.png", 2, "would write to the same place");
  expect_error("simulate cube.obj -o out --samples 1", 2, "it is an option of sprung animate");
}

TEST_F(Program, BadInputIsThree) {
  expect_error("animate missing.obj -o out", 3, "missing.obj");
  expect_error("animate missing.toml -o out", 3, "missing.toml");
  static_cast<void>(folder_.write("empty.obj", ""));
  expect_error("animate empty.obj -o out", 3, "empty.obj");
  static_cast<void>(folder_.write("bad.toml", "fbs = 3\n[[body]]\nmesh = \"nothing.obj\"\n"));
  expect_error("animate bad.toml -o out", 3, "sprung: error: bad.toml:1:1: unknown key 'fbs'");
  expect_error("animate bad.toml -o out", 3, "sprung: error: bad.toml:3:8: body.mesh");
  static_cast<void>(folder_.write("nameless.toml", "[[body]]\nmesh = \"\"\n"));
  expect_error("animate nameless.toml -o out", 3, "nameless.toml:2:8: body.mesh: is empty");
  expect_error("animate nameless.toml/ -o out", 3, "nameless.toml");
  expect_error("animate . -o out", 3, "is a directory");
  expect_error("animate /dev/null -o out", 3, "a device");
  expect_error("animate cube.obj -o out --brick-size 1m", 3, "larger than the body");
  expect_error("animate cube.obj -o out --texture cube.obj", 3, "has no UVs");
  EXPECT_FALSE(exists("out"));
}

TEST_F(Program, OutputsThatCannotBeWrittenAreSaidBeforeTheWork) {
  for (const std::string& output : {std::string("/proc/sprung/out"), "new/" + std::string(300, 'x') + "_{}.png"}) {
    const ProgramRun ended = run(kTiny + " -o " + output);
    EXPECT_EQ(ended.exit_code, 1) << ended.err;
    EXPECT_EQ(ended.err.find("simulate"), std::string::npos) << ended.err;
  }
  EXPECT_FALSE(exists("new"));
  const std::string too_long(300, 'x');
  expect_error(kTiny + " -o " + too_long + ".mp4", 1, "error: cannot use '" + too_long);
  expect_error(kTiny + " --bricks 6", 2, "--bricks is given 2 times");
}

TEST_F(Program, SaysWhereASurfaceCrossesItself) {
  std::string text = kCubeObj;
  text.replace(text.find("v 1 1 1"), 7, "v 0.5 0.5 -0.5");
  static_cast<void>(folder_.write("crossing.obj", text));
  const ProgramRun made = run("simulate crossing.obj -o out --bricks 12 --duration 0.05");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("the surface intersects itself: "), std::string::npos) << made.err;
  const ProgramRun plain = run("simulate cube.obj -o plain --bricks 12 --duration 0.05");
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(plain.err.find("crosses"), std::string::npos) << plain.err;
}

TEST_F(Program, WarnsOfBricksThatDoNotHoldTheMass) {
  const std::string knot = std::string("simulate ") + SPRUNG_SOURCE_DIR "/assets/models/knot.ply --duration 0.05 ";
  const ProgramRun coarse = run(knot + "-o coarse --bricks 1");
  EXPECT_NE(coarse.err.find("are too coarse: they hold "), std::string::npos) << coarse.err;
  const ProgramRun fine = run(knot + "-o fine --bricks 24");
  EXPECT_EQ(fine.exit_code, 0) << fine.err;
  EXPECT_EQ(fine.err.find("too coarse"), std::string::npos) << fine.err;
}

TEST_F(Program, RefusesWhatWouldTakeTooLong) {
  const ProgramRun ended = run("animate cube.obj --material gelatin -o out --size 1e-6 --time-limit 1h");
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  EXPECT_NE(ended.err.find("longer than --time-limit (1 h 00 min)"), std::string::npos) << ended.err;
}

TEST_F(Program, ASignalLeavesNoHalfFilm) {
  const std::string film = "animate cube.obj --bricks 2 --duration 100 --fps 100 --resolution 640x480 -o film.mp4";
  const ProgramRun ended = run_program(folder_, film, "timeout --preserve-status -s TERM 2");
  EXPECT_EQ(ended.exit_code, 143) << ended.err;
  EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
  EXPECT_FALSE(exists("film.mp4"));
  EXPECT_FALSE(exists("film.partial.mp4"));
}

TEST_F(Program, ResultsThatCannotBeWrittenAreAnError) {
  for (const std::string target : {">/dev/full", ">&-"}) {
    EXPECT_EQ(run("materials " + target + " 2>program.err #").exit_code, 1) << target;
    EXPECT_NE(text_of(folder_.path() / "program.err").find("stdout"), std::string::npos) << target;
  }
}

/// Runs in a terminal of its own, whose contents are `out`.
TEST_F(Program, ColourAndBarsOnlyWhereTheTerminalHasThem) {
  const auto shown = [&](const std::string& environment, const std::string& words) {
    return run_program(folder_, words + "\" /dev/null", environment + " script -qec \"").out;
  };
  EXPECT_NE(shown("TERM=xterm NO_COLOR=", "animate missing.obj -o out").find("\033[1;31m"), std::string::npos);
  EXPECT_EQ(shown("TERM=xterm NO_COLOR=1", "animate missing.obj -o out").find("\033[1;"), std::string::npos);
  EXPECT_EQ(shown("TERM=dumb", kTiny + " -o dumb").find('\033'), std::string::npos);
  EXPECT_NE(shown("TERM=xterm", kTiny + " -o bars").find("\r\033[Ksize: cube.obj"), std::string::npos);
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
  const std::string label = " below the ground (";
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
  const std::string shorter = "animate cube.obj --bricks 6 --duration 0.5 --fps 4 --resolution 160x120 -o out";
  static_cast<void>(folder_.write("out/frame_notes.png", ""));
  const ProgramRun replaced = run(shorter + " --overwrite");
  ASSERT_EQ(replaced.exit_code, 0);
  EXPECT_TRUE(exists("out/frame_0002.png"));
  EXPECT_FALSE(exists("out/frame_0003.png"));  // of the longer film
  EXPECT_TRUE(exists("out/frame_notes.png"));
  EXPECT_NE(replaced.err.find("of an earlier, longer film"), std::string::npos) << replaced.err;
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

TEST_F(Program, PrintedSceneKeepsWhatWasSet) {
  static_cast<void>(folder_.write("scene.toml",
                                  "duration = 0.5\nfps = 4\n[[body]]\nmesh = \"cube.obj\"\nscale = 0.07\n"
                                  "brick_size = 0.0175\ncolor = \"#123456\"\n"));
  const ProgramRun printed = run("simulate scene.toml --print-scene");
  for (const char* line : {"scale = 0.07", "brick_size = 0.0175", "color = \"#123456\""}) {
    EXPECT_NE(printed.out.find(line), std::string::npos) << printed.out;
  }
  static_cast<void>(folder_.write("printed.toml", printed.out));
  const ProgramRun first = run("simulate scene.toml -o a");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, run("simulate printed.toml -o b").out);
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
