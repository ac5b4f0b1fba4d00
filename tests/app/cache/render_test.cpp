#include <gtest/gtest.h>

#include <algorithm>

#include "app/film/frame_choice.h"
#include "core/io/process.h"
#include "render/image/png.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

const std::string kScene = R"(
fps = 10
duration = 0.5
[camera]
orbit = 40
[render]
resolution = [160, 120]
samples = 1
pins = true
contacts = true
traces = true
plots = true
[[obstacle]]
plane = { y = 0 }
[[obstacle]]
mesh = "ball.obj"
size = 0.1
position = [0.3, 0.1, 0]
keyframes = [ { t = 0 }, { t = 0.5, translate = [-0.1, 0, 0] } ]
[[body]]
mesh = "cube.obj"
bricks = 5
position = [0, 0.05, 0]
rotation = [0, 20, 0]
[[body.pin]]
box = { min = [0, 0, 0], max = [0.1, 1, 1] }
keyframes = [ { t = 0 }, { t = 0.5, translate = [0, 0.1, 0] } ]
[[probe]]
name = "corner"
body = 1
point = [0, 0, 0]
)";

TEST(Render, OfACacheIsWhatAnimateDraws) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  static_cast<void>(folder.write("ball.obj", kCubeObj));
  static_cast<void>(folder.write("scene.toml", kScene));
  ASSERT_EQ(run_program(folder, "animate scene.toml -o straight/").exit_code, 0);
  ASSERT_EQ(run_program(folder, "simulate scene.toml -o run.h5").exit_code, 0);
  // Nothing but the cache is needed.
  for (const char* name : {"cube.obj", "ball.obj", "scene.toml"}) std::filesystem::remove(folder.path() / name);
  const ProgramRun first = run_program(folder, "render run.h5 --frames 1:2 -o cached/");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  const ProgramRun rest = run_program(folder, "render run.h5 --frames 3: --jobs 2 -o cached/");
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  for (int frame = 1; frame <= 5; ++frame) {
    const std::string name = "frame_000" + std::to_string(frame) + ".png";
    ASSERT_TRUE(std::filesystem::exists(folder.path() / "cached" / name)) << name;
    EXPECT_EQ(text_of(folder.path() / "straight" / name), text_of(folder.path() / "cached" / name)) << name;
  }
  EXPECT_EQ(run_program(folder, "render run.h5 --frames 5 -o cached/").exit_code, 2);
  EXPECT_EQ(run_program(folder, "render run.h5 --frames 5 -o cached/ --overwrite").exit_code, 0);
  EXPECT_EQ(run_program(folder, "render run.h5 --frames 5 -o other/ --set duration=3").exit_code, 2);
  EXPECT_EQ(run_program(folder, "render run.h5 -o film.mp4 --resolution 80x60").exit_code, 0);
  EXPECT_EQ(run_program(folder, "render run.h5 -o two.mp4 --resolution 80x60 --jobs 2").exit_code, 0);
  EXPECT_EQ(text_of(folder.path() / "film.mp4"), text_of(folder.path() / "two.mp4"));
}

TEST(Render, DrawsEveryOtherFrameUnderNumbersOfItsUsersAndOnlyWhatIsMissing) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  ASSERT_EQ(run_program(folder, "simulate cube.obj --bricks 2 --duration 0.5 --fps 12 -o run.h5").exit_code, 0);
  const auto pictures = [&](const std::string& words) {
    const ProgramRun run = run_program(folder, "render run.h5 --resolution 80x60 " + words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out")) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  };
  EXPECT_EQ(pictures("-o 'out/f_####.png' --frames 1:6:2 --start-number 1001"),
            (std::vector<std::string>{"f_1001.png", "f_1003.png", "f_1005.png"}));
  const std::filesystem::path first = folder.path() / "out" / "f_1001.png";
  const auto written = std::filesystem::last_write_time(first);
  EXPECT_EQ(pictures("-o 'out/f_####.png' --start-number 1001 --skip-existing --jobs 2").size(), 6U);
  EXPECT_EQ(std::filesystem::last_write_time(first), written);
  std::filesystem::remove(folder.path() / "out" / "f_1003.png");
  const std::string missing = text_of(folder.path() / "out" / "f_1002.png");
  EXPECT_EQ(pictures("-o 'out/f_####.png' --start-number 1001 --skip-existing").size(), 6U);
  EXPECT_EQ(text_of(folder.path() / "out" / "f_1002.png"), missing);
  const ProgramRun none = run_program(folder, "render run.h5 -o 'out/f_####.png' --start-number 1001 --skip-existing");
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_NE(none.err.find("all pictures exist already"), std::string::npos) << none.err;
  EXPECT_EQ(run_program(folder, "render run.h5 -o film.mp4 --skip-existing").exit_code, 2);
  EXPECT_EQ(run_program(folder, "film 'out/f_####.png' -o film.mp4 --frames 1001:1006:2").exit_code, 0);
}

TEST(Render, DrawsOnePictureOrASheetOfMoments) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::string motion = "cube.obj --material gelatin --bricks 2 --duration 1 --fps 12 --size 5cm ";
  const std::string small = " --resolution 160x90";
  ASSERT_EQ(run_program(folder, "simulate " + motion + "-o run.h5").exit_code, 0);
  ASSERT_EQ(run_program(folder, "render run.h5 -o film/" + small).exit_code, 0);
  const ProgramRun still = run_program(folder, "render run.h5 -o still.png --time 0.25s" + small);
  EXPECT_EQ(still.exit_code, 0) << still.err;
  EXPECT_EQ(text_of(folder.path() / "still.png"), text_of(folder.path() / "film" / "frame_0004.png"));
  // Simulated only up to that frame, and framed for the motion up to it.
  const ProgramRun from_mesh = run_program(folder, "animate " + motion + "-o early.png --frame 4" + small);
  EXPECT_EQ(from_mesh.exit_code, 0) << from_mesh.err;
  EXPECT_NE(from_mesh.err.find("  4 frames"), std::string::npos) << from_mesh.err;
  const ProgramRun passes = run_program(folder, "animate " + motion + "-o p.exr --frame 4" + small);
  EXPECT_EQ(passes.exit_code, 0) << passes.err;
  EXPECT_NE(passes.err.find("  5 frames"), std::string::npos) << passes.err;  // they include the motion to the next one
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "p.exr"));
  const ProgramRun sheet = run_program(folder, "render run.h5 -o sheet.png -o film.gif" + small);
  EXPECT_EQ(sheet.exit_code, 0) << sheet.err;
  const Image image = read_png(folder.path() / "sheet.png");
  EXPECT_EQ(image.width, 160);
  EXPECT_EQ(image.height, 89);  // three rows of 29 pixels and two gutters
  for (int y = 0; y < image.height; ++y) EXPECT_EQ(image.pixels[3 * std::size_t(y * 160 + 52)], 255) << y;
  for (const char* words : {"-o p2.exr", "-o late.png --time 5s", "-o late.png --frame 13", "-o late.png --frame 0",
                            "-o two.png --frame 3 --time 0.1s", "-o still.png --frame 3"}) {
    EXPECT_EQ(run_program(folder, std::string("render run.h5 ") + words).exit_code, 2) << words;
  }
}

TEST(Render, StreamsToTheStandardOutput) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  ASSERT_EQ(run_program(folder, "simulate cube.obj --bricks 2 --duration 0.5 --fps 12 -o run.h5").exit_code, 0);
  const auto stream = [&](const std::string& words) {
    const ProgramRun run = run_program(folder, "render run.h5 --resolution 64x36 " + words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  };
  ASSERT_EQ(run_program(folder, "render run.h5 --resolution 64x36 -o p_{}.png").exit_code, 0);
  EXPECT_EQ(stream("-o - --frame 3"), text_of(folder.path() / "p_3.png"));
  EXPECT_EQ(stream("-o -.png --frames 3:4"), text_of(folder.path() / "p_3.png") + text_of(folder.path() / "p_4.png"));
  const std::string raw = stream("-o -.rgb --jobs 2");
  ASSERT_EQ(raw.size(), 6U * 3 * 64 * 36);
  const Image third = read_png(folder.path() / "p_3.png");
  EXPECT_TRUE(std::equal(third.pixels.begin(), third.pixels.end(), raw.begin() + 2 * 3 * 64 * 36,
                         [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
  EXPECT_EQ(stream("-o -.rgb --frame 1 --set render.transparent=true").size(), 4U * 64 * 36);
  if (find_program("ffmpeg")) {
    const std::string y4m = stream("-o -");
    EXPECT_TRUE(y4m.starts_with("YUV4MPEG2 W64 H36 F12:1")) << y4m.substr(0, 60);
    EXPECT_EQ(y4m.size(), y4m.find('\n') + 1 + 6 * (6U + 3 * 64 * 36));  // "FRAME\n" before each
  }
  EXPECT_EQ(run_program(folder, "render run.h5 -o - -o -.png").exit_code, 2);
}

TEST(Render, ByProcessesStopsWithTheFirstThatCannotGoOn) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  ASSERT_EQ(run_program(folder, "simulate cube.obj --bricks 2 --duration 0.5 --fps 12 -o run.h5").exit_code, 0);
  std::filesystem::create_directories(folder.path() / "out" / "frame_0002.png");
  const ProgramRun run =
      run_program(folder, "render run.h5 -o out/ -o film.mp4 --overwrite --jobs 3 --resolution 80x60");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("frame_0002.png"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "film.mp4"));
}

TEST(Render, SetsCachesSideBySide) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::string words = "simulate cube.obj --bricks 3 --duration 0.2 --fps 10 -o ";
  ASSERT_EQ(run_program(folder, words + "soft.h5 --young 5kPa").exit_code, 0);
  ASSERT_EQ(run_program(folder, words + "stiff.h5 --young 50kPa --model m1").exit_code, 0);
  const ProgramRun both =
      run_program(folder, "render soft.h5 stiff.h5 --side-by-side --resolution 160x60 --quality preview -o out/");
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(read_png(folder.path() / "out" / "frame_0002.png").width, 160);
  EXPECT_EQ(run_program(folder, "render soft.h5 stiff.h5 --side-by-side -o both.mp4 --resolution 160x60").exit_code, 0);
  EXPECT_EQ(run_program(folder, "render soft.h5 stiff.h5 -o two/").exit_code, 2);
  EXPECT_EQ(run_program(folder, "render soft.h5 --side-by-side -o two/").exit_code, 2);
  EXPECT_EQ(run_program(folder, "render soft.h5 stiff.h5 --side-by-side -o 'p_{}.exr'").exit_code, 2);
}

TEST(Render, SaysWhatIsWrongWithAFileThatIsNoCache) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  ASSERT_EQ(run_program(folder, "simulate cube.obj --material gelatin --bricks 4 --duration 0.1 -o run.h5").exit_code,
            0);
  static_cast<void>(folder.write("cut.h5", text_of(folder.path() / "run.h5").substr(0, 3000)));
  static_cast<void>(folder.write("other.h5", "something else"));
  const ProgramRun cut = run_program(folder, "render cut.h5 -o a/");
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_NE(cut.err.find("cannot read 'cut.h5': it is cut short"), std::string::npos) << cut.err;
  const ProgramRun other = run_program(folder, "render other.h5 -o a/");
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("it is not an HDF5 file"), std::string::npos) << other.err;
}

TEST(FrameRanges, AreReadAndRefused) {
  const auto words = [](const char* text) {
    const FrameRange range = parse_frame_range(text, 72);
    return std::pair(range.first, range.last);
  };
  EXPECT_EQ(words(""), std::pair(1, 72));
  EXPECT_EQ(words("3:48"), std::pair(3, 48));
  EXPECT_EQ(words("12:"), std::pair(12, 72));
  EXPECT_EQ(words(":12"), std::pair(1, 12));
  EXPECT_EQ(words("7"), std::pair(7, 7));
  EXPECT_EQ(parse_frame_range("3:9:3", 72).frames(), (std::vector{3, 6, 9}));
  EXPECT_EQ(parse_frame_range("::30", 72).frames(), (std::vector{1, 31, 61}));
  EXPECT_EQ(parse_frame_range("1:6:4", 72).count(), 2);
  for (const char* text : {"0:3", "5:4", "70:73", "x", "1-3", "1:2:0", "1:2:-1", "1:2:3:4"}) {
    EXPECT_NE(error_message([&] { words(text); }), "") << text;
  }
}

}  // namespace
}  // namespace sprung
