#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "core/simulation/cache.h"
#include "tests/support/running_program.h"
#include "tests/support/sanitized.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A third of a second for the work, the rest for a busy machine: measured alone, 0.34 s at most.
constexpr auto kSoon = std::chrono::milliseconds(test::kSanitized ? 8000 : 900);

/// Commands that take seconds, and what they may leave behind when they are stopped.
struct LongCommand {
  const char* name;
  std::string words;
  std::string file;  // what it makes
};

const std::string kKnot = SPRUNG_SOURCE_DIR "/assets/models/knot.ply";
const std::string kBear = SPRUNG_SOURCE_DIR "/assets/models/bear.ply";
const std::string kHeld = "simulate held.toml -o run.h5 --set ";

const LongCommand kCommands[] = {
    {"fill", "inspect " + kBear + " --material gelatin --bricks 250", ""},
    {"motion", "simulate " + kKnot + " --bricks 30 --duration 20 -o run.h5", "run.h5"},
    {
        "implicit",
        "simulate " + kKnot + " --scheme bdf2 --material rubber --bricks 60 --duration 20 -o run.h5",
        "run.h5",
    },
    {"statics", kHeld + "body.bricks=56", "run.h5"},
    {"modes", kHeld + "body.bricks=48 --set solver.scheme=modes --set solver.modes=40", "run.h5"},
    {"film", "animate " + kKnot + " --duration 20 --quality high -o film.mp4", "film.mp4"},
    {"pictures", "animate " + kKnot + " --duration 20 --jobs 2 --quality high -o shots/", ""},
    {"render", "render made.h5 --resolution 3840x2160 --quality high -o film.mp4", "film.mp4"},
    {"encode", "render made.h5 --resolution 3840x2160 --quality preview --jobs 2 -o film.mp4", "film.mp4"},
    {"export", "export " + kKnot + " --duration 20 -o film.glb", "film.glb"},
    {"validate", "validate --report report", ""},
};

class Signals : public testing::TestWithParam<LongCommand> {
 protected:
  Signals() {
    static_cast<void>(folder_.write("held.toml",
                                    "duration = 1\n[solver]\nscheme = \"static\"\nload_steps = 20\n"
                                    "[[body]]\nmesh = '" +
                                        kKnot +
                                        "'\nmaterial = \"gelatin\"\n[[body.pin]]\n"
                                        "box = { min = [0, 0.8, 0], max = [1, 1, 1] }\n"));
  }

  /// Whether anything unfinished is there.
  [[nodiscard]] std::vector<std::string> unfinished() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      std::string name = entry.path().filename().string();
      if (name.find("partial") != std::string::npos) names.push_back(std::move(name));
    }
    return names;
  }

  TempFolder folder_;
};

/// At random moments, from the first instant on: the program ends soon and its exit code says why; the files it leaves
/// are complete.
TEST_P(Signals, AreHeardSoonAtAnyMoment) {
  const LongCommand& command = GetParam();
  if (command.words.find("made.h5") != std::string::npos) {
    ASSERT_EQ(
        run_program(folder_, "simulate " + kKnot + " --material gelatin --bricks 10 --duration 2 -o made.h5").exit_code,
        0);
  }
  std::mt19937 random(unsigned(std::hash<std::string>{}(command.words)));
  std::uniform_real_distribution<double> moments(-2.0, 1.2);  // of the logarithm of ms / 10
  for (const int number : {SIGTERM, SIGINT, SIGTERM}) {
    const double milliseconds = 100 * std::pow(10, moments(random));
    SCOPED_TRACE(fmt::format("signal {} after {:.1f} ms", number, milliseconds));
    std::istringstream stream(command.words);
    RunningProgram program(folder_, {std::istream_iterator<std::string>(stream), {}});
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(10 + milliseconds));
    const auto begin = Clock::now();
    program.signal(number);
    const ProgramRun ended = program.wait();
    EXPECT_LT(Clock::now() - begin, kSoon) << ended.err;
    // Before its handlers are installed a signal ends it like any program.
    EXPECT_TRUE(ended.exit_code == 128 + number || ended.exit_code == -1) << ended.exit_code << ended.err;
    EXPECT_TRUE(unfinished().empty()) << unfinished().front();
    if (command.file.empty()) continue;
    const fs::path file = folder_.path() / command.file;
    if (file.extension() == ".h5") {
      EXPECT_TRUE(!fs::exists(file) || CacheReader(file).frame_count() >= 1);
    } else {
      EXPECT_FALSE(fs::exists(file));
    }
    fs::remove(file);
    fs::remove_all(folder_.path() / "shots");
    fs::remove_all(folder_.path() / "report");
  }
}

INSTANTIATE_TEST_SUITE_P(All, Signals, testing::ValuesIn(kCommands),
                         [](const auto& one) { return std::string(one.param.name); });

/// If no forecast can be made.
TEST(TimeLimit, EndsWhateverTakesLonger) {
  const TempFolder folder;
  const auto begin = Clock::now();
  const ProgramRun ended =
      run_program(folder, "inspect " + kBear + " --material gelatin --bricks 250 --set solver.time_limit=0.5");
  EXPECT_LT(Clock::now() - begin, 2 * kSoon + std::chrono::milliseconds(500));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("stopped after 500 ms, the limit set by --time-limit"), std::string::npos) << ended.err;
}

TEST(TimeLimit, MayBeForever) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const ProgramRun ended =
      run_program(folder, "inspect cube.obj --material gelatin --bricks 4 --set solver.time_limit=1e300");
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

}  // namespace
}  // namespace sprung
