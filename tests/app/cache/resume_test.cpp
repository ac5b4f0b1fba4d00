#include <gtest/gtest.h>

#include <random>

#include "app/scene/cached_film.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"
#include "tests/support/sanitized.h"

namespace sprung {
namespace {

const Observer kSilent;

/// What the scenes below have in common: some 0.6 s of two boxes.
const std::string kTwoBoxes = R"(
fps = 20
duration = 0.6
[[obstacle]]
plane = { y = 0 }
[[body]]
box = [0.1, 0.1, 0.1]
bricks = 4
position = [0, 0.05, 0]
spin = [50, 20, 300]
[[body]]
box = [0.1, 0.1, 0.1]
bricks = 3
position = [0.02, 0.2, 0]
)";

/// A pin that catches its nodes in the middle of a frame, and a moving obstacle.
const std::string kLatePin = R"(
  [[body.pin]]
  name = "hand"
  box = { min = [0, 0.7, 0], max = [1, 1, 1] }
  from = 0.13
  until = 0.41
  keyframes = [ { t = 0.13 }, { t = 0.37, rotate = [0, 0, 80], translate = [0, 0.05, 0] } ]
[[obstacle]]
box = [0.05, 0.05, 0.05]
position = [-0.2, 0.05, 0]
keyframes = [ { t = 0 }, { t = 0.5, translate = [0.2, 0, 0] } ]
[[probe]]
name = "hand"
body = 2
pin = "hand"
)";

const std::string kHangingBar = R"(
fps = 20
duration = 0.6
[[body]]
box = [0.3, 0.1, 0.1]
bricks = 6
material = { young = "30 kPa", poisson = 0.45, density = 1100, damping = 0.01 }
  [[body.pin]]
  box = { min = [0, 0, 0], max = [0.1, 1, 1] }
)";

std::vector<std::uint64_t> hashes_of(const std::filesystem::path& file) {
  const CacheReader cache(file);
  std::vector<std::uint64_t> hashes;
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) hashes.push_back(cache.frame(frame).state_hash);
  return hashes;
}

Recording run(const std::string& text, double duration, const std::filesystem::path& file, bool resume,
              double position_error = 0) {
  Film scene = parse_scene(text, "/scene.toml");
  scene.duration = duration;
  Simulation simulation = prepare_simulation(scene, kSilent);
  RunCache cache(file, record_of(scene), resume, position_error);
  Recording recording = simulate(simulation, scene, kSilent, &cache);
  cache.close();
  return recording;
}

/// In one run, and resumed twice in between.
void expect_same_bits(const std::string& text) {
  const TempFolder folder;
  const Recording straight = run(text, 0.6, folder.path() / "straight.h5", false);
  static_cast<void>(run(text, 0.2, folder.path() / "parts.h5", true));
  static_cast<void>(run(text, 0.3, folder.path() / "parts.h5", true));
  const Recording resumed = run(text, 0.6, folder.path() / "parts.h5", true);
  EXPECT_EQ(hashes_of(folder.path() / "straight.h5"), hashes_of(folder.path() / "parts.h5"));
  EXPECT_EQ(straight.state_hash, resumed.state_hash);
  ASSERT_EQ(straight.probes.size(), resumed.probes.size());
  for (std::size_t probe = 0; probe < straight.probes.size(); ++probe) {
    const auto& expected = straight.probes[probe].samples;
    const auto& samples = resumed.probes[probe].samples;
    ASSERT_EQ(expected.size(), samples.size());
    for (std::size_t frame = 0; frame < samples.size(); ++frame) EXPECT_EQ(expected[frame].force, samples[frame].force);
  }
}

TEST(Resume, BodiesThatTouchGoOnBitByBit) { expect_same_bits(kTwoBoxes); }

TEST(Resume, PinsThatCatchLateGoOnBitByBit) { expect_same_bits(kTwoBoxes + kLatePin); }

/// A bar that falls gently onto the ground and lies there from 0.1 s on.
const std::string kComesToRest = R"(
until_still = 0.2
fps = 100
[[obstacle]]
plane = {}
[[body]]
box = [0.1, 0.05, 0.05]
position = [0, 0.001, 0]
bricks = 4
material = { young = "1 MPa", poisson = 0.45, density = 1000, damping = 0.1 }
)";

TEST(Resume, AFilmThatEndsAtRestEndsInTheSameFrame) {
  expect_same_bits(kComesToRest);
  const TempFolder folder;
  const Recording once = run(kComesToRest, 2, folder.path() / "run.h5", false);
  EXPECT_GT(once.progress.back(), 0.25);
  EXPECT_LT(once.progress.back(), 0.6);
  const Recording again = run(kComesToRest, 2, folder.path() / "run.h5", true);
  EXPECT_EQ(again.progress, once.progress);
}

TEST(Resume, EverySchemeGoesOnBitByBit) {
  for (const std::string scheme : {"verlet", "implicit-euler", "bdf2"}) {
    SCOPED_TRACE(scheme);
    expect_same_bits(kHangingBar + "[solver]\nscheme = \"" + scheme + "\"\n");
  }
}

/// The first frames of a cache as a cache, possibly with another header.
void cut(
    const std::filesystem::path& whole, std::size_t frames, const std::filesystem::path& file,
    const std::function<void(CacheHeader&)>& change = [](CacheHeader&) {}) {
  const CacheReader cache(whole);
  CacheHeader header = cache.header();
  change(header);
  CacheWriter writer(file, header, cache.memory(0).size());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::vector<Points> positions = cache.positions(frame);
    const std::vector<Points> velocities = cache.velocities(frame);
    writer.append(cache.frame(frame), {&positions.at(0)}, {&velocities.at(0)}, cache.memory(frame));
  }
  writer.publish();
  writer.close();
}

TEST(Resume, StatesOfRestGoOnBitByBit) {
  const TempFolder folder;
  const std::string text = kHangingBar + "[solver]\nscheme = \"static\"\nload_steps = 4\n";
  static_cast<void>(run(text, 0.6, folder.path() / "straight.h5", false));
  cut(folder.path() / "straight.h5", 3, folder.path() / "cut.h5");
  static_cast<void>(run(text, 0.6, folder.path() / "cut.h5", true));
  EXPECT_EQ(hashes_of(folder.path() / "straight.h5").size(), 5U);
  EXPECT_EQ(hashes_of(folder.path() / "straight.h5"), hashes_of(folder.path() / "cut.h5"));
  EXPECT_NE(error_message([&] { static_cast<void>(run(text, 0.7, folder.path() / "cut.h5", true)); }).find("duration"),
            std::string::npos);
}

TEST(Resume, NamesWhatIsAnother) {
  const TempFolder folder;
  const auto file = folder.path() / "run.h5";
  static_cast<void>(run(kHangingBar, 0.2, file, false));
  const auto refusal = [&](const std::string& from, const std::string& to, double duration) {
    std::string text = kHangingBar;
    text.replace(text.find(from), from.size(), to);
    return error_message([&] { static_cast<void>(run(text, duration, file, true)); });
  };
  EXPECT_NE(refusal("30 kPa", "31 kPa", 0.6).find("[[body]] material"), std::string::npos)
      << refusal("30 kPa", "31 kPa", 0.6);
  EXPECT_NE(refusal("fps = 20", "fps = 25", 0.6).find("fps = 20"), std::string::npos);
  EXPECT_NE(refusal("fps = 20", "fps = 20", 0.1).find("more than the"), std::string::npos);
  EXPECT_EQ(refusal("fps = 20", "fps = 20", 0.25), "");
  EXPECT_EQ(hashes_of(file).size(), 5U);
  const auto refusal_of = [&](const std::function<void(CacheHeader&)>& change) {
    const auto other = folder.path() / "other.h5";
    cut(file, 2, other, change);
    return error_message([&] { static_cast<void>(run(kHangingBar, 0.2, other, true)); });
  };
  EXPECT_NE(refusal_of([](CacheHeader& header) { header.version = "0.0.7"; }).find("made by sprung 0.0.7"),
            std::string::npos);
  EXPECT_NE(refusal_of([](CacheHeader& header) { header.build = "abc"; }).find("another build"), std::string::npos);
  EXPECT_NE(refusal_of([](CacheHeader& header) {
              header.simulation.world.bodies[0].masses[0] *= 2;
            }).find("the mesh of body 1"),
            std::string::npos);
}

TEST(Resume, FromRoundedFramesGoesOnBitByBit) {
  const TempFolder folder;
  const auto file = folder.path() / "rounded.h5";
  static_cast<void>(run(kTwoBoxes, 0.6, folder.path() / "straight.h5", false));
  for (const double duration : {0.2, 0.3, 0.6}) static_cast<void>(run(kTwoBoxes, duration, file, true, 1e-5));
  EXPECT_EQ(hashes_of(folder.path() / "straight.h5"), hashes_of(file));
  const CacheReader exact(folder.path() / "straight.h5");
  const CacheReader rounded(file);
  for (std::size_t frame = 0; frame < exact.frame_count(); ++frame) {
    EXPECT_LE((exact.positions(frame).at(1) - rounded.positions(frame).at(1)).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LE((exact.velocities(frame).at(1) - rounded.velocities(frame).at(1)).cwiseAbs().maxCoeff(), 20 * 1e-5);
  }
  const std::string refusal = error_message([&] { static_cast<void>(run(kTwoBoxes, 0.7, file, true)); });
  EXPECT_NE(refusal.find("kept to within 1e-05 m, here it is to the last bit"), std::string::npos) << refusal;
}

TEST(Resume, RoundedCachesSayHowFarOffTheyAre) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::string bricks = test::kSanitized ? "8" : "12";
  const std::string simulate = "simulate cube.obj --size 10cm --duration 1 --bricks " + bricks + " ";
  ASSERT_EQ(run_program(folder, simulate + "-o exact.h5").exit_code, 0);
  const ProgramRun made = run_program(folder, simulate + "-o rounded.h5 --position-error 0.01mm");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(run_program(folder, "inspect exact.h5").out.find("positions to the last bit\n"), std::string::npos);
  EXPECT_NE(run_program(folder, "inspect rounded.h5")
                .out.find("positions to within 1e-05 m, velocities to within 0.00024 m/s\n"),
            std::string::npos);
  EXPECT_NE(run_program(folder, "inspect rounded.h5 --json").out.find("\"position_error\": 1e-05"), std::string::npos);
  EXPECT_LT(1.7 * double(std::filesystem::file_size(folder.path() / "rounded.h5")),
            double(std::filesystem::file_size(folder.path() / "exact.h5")));
  EXPECT_EQ(run_program(folder, simulate + "-o other.h5 --position-error 0").exit_code, 2);
  EXPECT_EQ(run_program(folder, simulate + "-o folder/ --position-error 1mm").exit_code, 2);
}

const std::string kFewBricks = test::kSanitized ? "4" : "8";

/// How often the program is killed while running, each time after some seconds; sanitizers make it slower.
constexpr int kKills = test::kSanitized ? 6 : 20;
constexpr double kShortest = test::kSanitized ? 2 : 0.1;
constexpr double kLongest = test::kSanitized ? 20 : 0.4;

TEST(Resume, ProgramKilledAtRandomMomentsComesToTheSameEnd) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::string simulate =
      "simulate cube.obj --material gelatin --bricks " + kFewBricks + " --fps 100 --duration 1 --resume -o ";
  std::mt19937 random(20091);
  std::size_t done = 0;
  for (int i = 0; i < kKills; ++i) {
    const double seconds = std::uniform_real_distribution(kShortest, kLongest)(random);
    static_cast<void>(run_program(folder, simulate + "killed.h5", "timeout -s KILL " + std::to_string(seconds)));
    if (!std::filesystem::exists(folder.path() / "killed.h5")) continue;
    const std::size_t frames = CacheReader(folder.path() / "killed.h5").frame_count();
    EXPECT_GE(frames, done);
    done = frames;
  }
  EXPECT_GT(done, 0U);
  EXPECT_EQ(run_program(folder, simulate + "killed.h5").exit_code, 0);
  EXPECT_EQ(run_program(folder, simulate + "straight.h5").exit_code, 0);
  EXPECT_EQ(hashes_of(folder.path() / "killed.h5"), hashes_of(folder.path() / "straight.h5"));
}

TEST(Resume, AnInterruptSaysHowToGoOn) {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  const std::string simulate =
      "simulate cube.obj --material gelatin --bricks " + kFewBricks + " --fps 100 --duration 60 -o run.h5";
  const ProgramRun ended =
      run_program(folder, simulate, "timeout --preserve-status -s INT " + std::string(test::kSanitized ? "20" : "1.5"));
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_NE(ended.err.find(simulate + " --resume"), std::string::npos) << ended.err;
  const CacheReader cache(folder.path() / "run.h5");
  EXPECT_GT(cache.frame_count(), 1U);
  EXPECT_NE(run_program(folder, simulate).err.find("say --resume to go on with it"), std::string::npos);
}

}  // namespace
}  // namespace sprung
