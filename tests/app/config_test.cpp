#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace sprung {
namespace {

class Config : public testing::Test {
 protected:
  Config() {
    std::filesystem::create_directories(folder_.path() / "shot");
    static_cast<void>(folder_.write("shot/cube.obj", kCubeObj));
    static_cast<void>(
        folder_.write("shot/scene.toml", "fps = 12\n[[body]]\nmesh = \"cube.obj\"\nsize = 0.2\nbricks = 4\n"));
  }
  /// Runs the program in the folder of the shot.
  [[nodiscard]] ProgramRun run(const std::string& words, const std::string& before = "") const {
    return run_program(folder_, words, "env -C shot " + before);
  }

  TempFolder folder_;
};

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST_F(Config, RanksBelowTheSceneAndTheCommandLine) {
  static_cast<void>(folder_.write("sprung.toml", R"(
fps = 25
duration = "0.5s"
quality = "high"
young = "9kPa"
set = ["render.caption=ACME"]
[simulate]
duration = "0.25s"
)"));
  const ProgramRun printed = run("animate scene.toml --print-scene --quality preview");
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_TRUE(has(printed.out, "fps = 12\n")) << "the scene's";
  EXPECT_TRUE(has(printed.out, "duration = 0.5\n"));
  EXPECT_TRUE(has(printed.out, "quality = \"preview\"")) << "typed";
  EXPECT_TRUE(has(printed.out, "young = 9000")) << printed.out;
  EXPECT_TRUE(has(printed.out, "caption = \"ACME\""));
  const ProgramRun simulated = run("simulate scene.toml --print-scene");
  EXPECT_TRUE(has(simulated.out, "duration = 0.25\n")) << "of the command";
  EXPECT_TRUE(has(simulated.out, "quality = \"high\"")) << "for whoever draws the cache";
  EXPECT_TRUE(has(run("simulate cube.obj --print-scene --material rubber").out, "fps = 25\n")) << "a bare mesh";
  EXPECT_FALSE(has(run("simulate scene.toml --print-scene", "SPRUNG_CONFIG=").out, "ACME")) << "kept from looking";
}

TEST_F(Config, GivesDefaultsToOtherOptions) {
  static_cast<void>(folder_.write("site.toml", "threads = 1\nquiet = true\n[simulate]\noverwrite = true\n"));
  const std::string site = "SPRUNG_CONFIG=../site.toml ";
  const std::string words = "simulate scene.toml --duration 0.1 -o run.h5";
  ASSERT_EQ(run(words, site).exit_code, 0);
  EXPECT_EQ(run(words).exit_code, 2) << "it exists";
  const ProgramRun again = run(words, site);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err, "") << "quiet";
}

TEST_F(Config, PrintsWhatHoldsAndFromWhere) {
  EXPECT_TRUE(has(run("config", "SPRUNG_CONFIG=").out, "no defaults"));
  static_cast<void>(folder_.write("sprung.toml", "fps = 25\nquality = \"high\"\n[film]\nfps = 23.976\n"));
  const ProgramRun here = run("config");
  EXPECT_EQ(here.exit_code, 0) << here.err;
  EXPECT_TRUE(has(here.out, "sprung.toml, the nearest one")) << here.out;
  EXPECT_TRUE(has(here.out, "1  fps = 25    of animate, simulate")) << here.out;
  EXPECT_TRUE(has(here.out, "2  quality = high    of animate, simulate, export, inspect\n")) << here.out;
  EXPECT_TRUE(has(here.out, "4  fps = 23.976    of film\n")) << here.out;
}

TEST_F(Config, SaysWhatIsWrong) {
  const auto complaint = [&](const std::string& text) {
    static_cast<void>(folder_.write("sprung.toml", text));
    const ProgramRun refused = run("simulate scene.toml -o run.h5");
    EXPECT_EQ(refused.exit_code, 3) << refused.err;
    return refused.err;
  };
  EXPECT_TRUE(has(complaint("\nfpt = 25"), "sprung.toml:2: unknown option 'fpt'; did you mean '--fps'?"));
  EXPECT_TRUE(has(complaint("[simulat]\nfps = 25"), "unknown command 'simulat'; did you mean 'simulate'?"));
  EXPECT_TRUE(has(complaint("[render]\nquality = \"high\""), "render draws caches, which hold what 'quality' was"));
  EXPECT_TRUE(has(complaint("output = \"a.h5\""), "'output' is not for defaults"));
  EXPECT_TRUE(has(complaint("duration = \"soon\""), "sprung.toml:1: --duration"));
  EXPECT_TRUE(has(complaint("[[body]]\nmesh = \"a.obj\""), "a scene needs another name"));
  EXPECT_TRUE(has(complaint("fps = "), "sprung.toml:1:"));
  for (const char* words : {"help", "", "--version", "simulate --help"}) {
    EXPECT_EQ(run(words).exit_code, 0) << words << ": helps all the same";
  }
  EXPECT_TRUE(has(run("config", "SPRUNG_CONFIG=nowhere.toml ").err, "'nowhere.toml' is not there"));
}

}  // namespace
}  // namespace sprung
