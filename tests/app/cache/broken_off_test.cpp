#include <gtest/gtest.h>

#include "core/error.h"
#include "core/simulation/cache.h"
#include "tests/support/running_program.h"
#include "tests/support/sanitized.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

// Sanitizers make it ten times slower.
const std::string kFew = test::kSanitized ? "6" : "10";
const std::string kMany = test::kSanitized ? "10" : "24";
const std::string kShortFrames = "simulate cube.obj --bricks " + kFew + " --fps 100 --duration 0.5 -o ";
const std::vector<std::string> kLongFrames{"simulate", "cube.obj",   "--bricks", kMany, "--fps",
                                           "0.5",      "--duration", "20",       "-o",  "run.h5"};

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::uint64_t last_hash(const fs::path& file) {
  const CacheReader cache(file);
  return cache.frame(cache.frame_count() - 1).state_hash;
}

/// False while the cache is not there, or has just been begun.
bool has_frame(const fs::path& file) {
  try {
    return fs::exists(file) && CacheReader(file).frame_count() > 0;
  } catch (const Error&) {
    return false;
  }
}

/// The command that the program gives.
std::string advice_in(const std::string& err) {
  const std::string begin = "go on with: ";
  const auto place = err.find(begin);
  if (place == std::string::npos) return "";
  const auto first = place + begin.size();
  return err.substr(first, err.find('\n', first) - first);
}

class BrokenOff : public testing::Test {
 protected:
  BrokenOff() {
    static_cast<void>(folder_.write("cube.obj", kCubeObj));
    EXPECT_EQ(run_program(folder_, kShortFrames + "straight.h5").exit_code, 0);
  }

  /// The cache so far can be read, and the command that the program gave completes it as an uninterrupted run would.
  void expect_goes_on(const std::string& err, const fs::path& cache) const {
    const fs::path file = folder_.path() / cache;
    EXPECT_GE(CacheReader(file).frame_count(), 1U);
    const std::string advice = advice_in(err);
    ASSERT_NE(advice, "") << err;
    const std::string line = "cd '" + folder_.path().string() + "' && " + advice + " >again.out 2>again.err";
    EXPECT_EQ(std::system(line.c_str()), 0) << line << '\n' << text_of(folder_.path() / "again.err");
    EXPECT_EQ(last_hash(file), last_hash(folder_.path() / "straight.h5"));
  }

  TempFolder folder_;
};

TEST_F(BrokenOff, BySignalsItSaysHowToGoOn) {
  for (const int number : {SIGINT, SIGTERM}) {
    const std::string name = "run" + std::to_string(number) + ".h5";
    RunningProgram program(folder_, words_in(kShortFrames + name));
    ASSERT_TRUE(program.wait_for(folder_.path() / name));
    program.signal(number);
    const ProgramRun ended = program.wait();
    EXPECT_EQ(ended.exit_code, 128 + number) << ended.err;
    EXPECT_LT(CacheReader(folder_.path() / name).frame_count(), 50U);
    expect_goes_on(ended.err, name);
  }
}

/// It does not wait for the end of the frame.
TEST_F(BrokenOff, InALongFrameItStopsAtOnceAndStaysReadable) {
  RunningProgram program(folder_, kLongFrames);
  ASSERT_TRUE(program.wait_until([this] { return has_frame(folder_.path() / "run.h5"); }));
  const auto begin = std::chrono::steady_clock::now();
  program.signal(SIGTERM);
  const ProgramRun ended = program.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(test::kSanitized ? 5000 : 1000));
  EXPECT_EQ(ended.exit_code, 143) << ended.err;
  const CacheReader cache(folder_.path() / "run.h5");
  ASSERT_EQ(cache.frame_count(), 1U);
  EXPECT_GT(cache.positions(0).at(0).rows(), 8);
}

/// If a film's encoder ends, or the film is interrupted, its motion is kept, and the same command resumes from it.
TEST_F(BrokenOff, AFilmKeepsItsMotionUntilItIsWhole) {
  const std::string words =
      "animate cube.obj --material gelatin --bricks " + kFew + " --duration 1 --resolution 320x180 -o film.mp4 ";
  const fs::path motion = folder_.path() / "film.unfinished.h5";
  EXPECT_EQ(run_program(folder_, words + "--keep-after soon").exit_code, 2);
  const ProgramRun quick = run_program(folder_, words);
  EXPECT_EQ(quick.exit_code, 0) << quick.err;
  EXPECT_FALSE(fs::exists(motion));
  const std::string straight = text_of(folder_.path() / "film.mp4");
  fs::create_directory(folder_.path() / "bin");
  static_cast<void>(folder_.write("bin/ffmpeg", "#!/bin/sh\nhead -c 300000 >/dev/null\nexit 1\n"));
  fs::permissions(folder_.path() / "bin/ffmpeg", fs::perms::owner_all);
  const ProgramRun broken = run_program(folder_, words + "--keep-after 0s --overwrite",
                                        "env PATH=" + (folder_.path() / "bin").string() + ":$PATH");
  EXPECT_EQ(broken.exit_code, 1) << broken.err;
  EXPECT_NE(broken.err.find("24 frames, is kept in film.unfinished.h5; the same command resumes from it"),
            std::string::npos)
      << broken.err;
  EXPECT_EQ(CacheReader(motion).frame_count(), 24U);
  const ProgramRun whole = run_program(folder_, words + "--keep-after 0s --overwrite");
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_NE(whole.err.find("resuming from the motion in film.unfinished.h5"), std::string::npos) << whole.err;
  EXPECT_NE(whole.err.find("24 frames, 0 of them in this run"), std::string::npos) << whole.err;
  EXPECT_FALSE(fs::exists(motion));
  EXPECT_EQ(text_of(folder_.path() / "film.mp4"), straight);
}

TEST_F(BrokenOff, AMotionIsKeptInAFolderThatIsNotYetMade) {
  const ProgramRun made =
      run_program(folder_, "animate cube.obj --material gelatin --bricks " + kFew +
                               " --duration 0.2 --resolution 64x36 -o new/pictures/ --jobs 1 --keep-after 0s");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(fs::exists(folder_.path() / "new/pictures/frame_0001.png"));
  EXPECT_FALSE(fs::exists(folder_.path() / "new/pictures/unfinished.h5"));
}

TEST_F(BrokenOff, ByAVanishedFolderItSaysSo) {
  fs::create_directory(folder_.path() / "shelf");
  RunningProgram program(folder_, words_in(kShortFrames + "shelf/run.h5"));
  ASSERT_TRUE(program.wait_for(folder_.path() / "shelf/run.h5"));
  fs::rename(folder_.path() / "shelf", folder_.path() / "elsewhere");
  const ProgramRun ended = program.wait();
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("'shelf/run.h5' was removed or replaced"), std::string::npos) << ended.err;
  fs::rename(folder_.path() / "elsewhere", folder_.path() / "shelf");
  expect_goes_on(ended.err, "shelf/run.h5");
}

/// A disk of its own if this process may mount one, else a limit on the size of files.
TEST_F(BrokenOff, ByAFullDiskItSaysSo) {
  const auto run_on_small_disk = [&](const std::string& before, const std::string& after) {
    fs::create_directories(folder_.path() / "disk");
    const std::string script =
        before + " '" SPRUNG_PROGRAM "' " + kShortFrames + "disk/run.h5; code=$?; " + after + " exit $code";
    static_cast<void>(folder_.write("script", script));
  };
  const bool can_mount = std::system("unshare -m mount -t tmpfs tmpfs /mnt 2>/dev/null") == 0;
  run_on_small_disk(can_mount ? "mount -t tmpfs -o size=512k tmpfs disk &&" : "trap '' XFSZ; ulimit -f 1024;",
                    can_mount ? "cp disk/run.h5 kept.h5; umount disk; mv kept.h5 disk/run.h5;" : "");
  const std::string line = "cd '" + folder_.path().string() + "' && " + (can_mount ? "unshare -m " : "") +
                           "sh script >program.out 2>program.err";
  const int status = std::system(line.c_str());
  const std::string err = text_of(folder_.path() / "program.err");
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1) << err;
  EXPECT_NE(err.find(can_mount ? "No space left on device" : "File too large"), std::string::npos) << err;
  EXPECT_GT(CacheReader(folder_.path() / "disk/run.h5").frame_count(), 1U);
  expect_goes_on(err, "disk/run.h5");
}

/// A prefix that makes file modes apply to this process even if it is root.
std::string without_privileges() { return geteuid() == 0 ? "setpriv --bounding-set=-dac_override " : ""; }

TEST_F(BrokenOff, InAReadOnlyFolderItDoesNotBegin) {
  fs::create_directory(folder_.path() / "shelf");
  fs::copy(folder_.path() / "straight.h5", folder_.path() / "shelf/run.h5");
  fs::permissions(folder_.path() / "shelf", fs::perms::owner_read | fs::perms::owner_exec);
  if (std::system((without_privileges() + "true 2>/dev/null").c_str()) != 0) GTEST_SKIP() << "setpriv is not allowed";
  const std::vector<std::string> all{
      kShortFrames + "shelf/new.h5", kShortFrames + "shelf/run.h5 --overwrite",
      "simulate cube.obj --bricks " + kFew + " --fps 100 --duration 1 -o shelf/run.h5 --resume",
      "export straight.h5 -o shelf/film.glb", "render straight.h5 -o shelf/frame_{}.png"};
  for (const std::string& words : all) {
    const ProgramRun ended = run_program(folder_, words, without_privileges());
    EXPECT_EQ(ended.exit_code, 1) << words << '\n' << ended.err;
    EXPECT_NE(ended.err.find("cannot write 'shelf/"), std::string::npos) << words << '\n' << ended.err;
    EXPECT_NE(ended.err.find("Permission denied"), std::string::npos) << words << '\n' << ended.err;
  }
  fs::permissions(folder_.path() / "shelf", fs::perms::owner_all);
  EXPECT_EQ(text_of(folder_.path() / "shelf/run.h5"), text_of(folder_.path() / "straight.h5"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "shelf"), {}), 1);
}

}  // namespace
}  // namespace sprung
