#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/support/run_program.h"

namespace sprung {
namespace {

const std::vector<std::string> kCommands{"animate", "simulate", "render",   "export",  "film",      "sweep",
                                         "load",    "inspect",  "validate", "compare", "materials", "help"};

class HelpText : public testing::Test {
 protected:
  [[nodiscard]] std::string text(const std::string& words) const {
    const ProgramRun run = run_program(folder_, words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  }
  [[nodiscard]] std::string error(const std::string& words) const { return run_program(folder_, words).err; }

  TempFolder folder_;
};

TEST_F(HelpText, AloneTheProgramNamesThreeCommands) {
  const std::string greeting = text("");
  for (const char* command : {"sprung animate ", "sprung inspect ", "sprung materials "}) {
    EXPECT_NE(greeting.find(command), std::string::npos) << command;
  }
  EXPECT_LE(std::count(greeting.begin(), greeting.end(), '\n'), 8);
}

TEST_F(HelpText, OfEveryCommandFitsAScreenAndHasAnExample) {
  for (const std::string& command : kCommands) {
    const std::string help = text(command + " --help");
    EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 40) << help;
    EXPECT_NE(help.find("\n  sprung " + command), std::string::npos) << help;
  }
  const std::string help = text("--help");
  EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 40) << help;
}

TEST_F(HelpText, HasNoLineOfMoreThanAHundredColumns) {
  std::vector<std::string> all{"help", "--help"};
  for (const std::string& command : kCommands) {
    all.push_back("help " + command);
    all.push_back(command + " --help");
  }
  for (const std::string& words : all) {
    std::istringstream lines(text(words));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << words << "\n" << line;
  }
  // Broken lines continue below their beginning.
  EXPECT_NE(text("help animate").find("strain or\n                                  stress (von Mises), volume"),
            std::string::npos);
}

TEST_F(HelpText, OnACommandNamesWhatTheShortOneLeavesOut) {
  EXPECT_EQ(text("animate --help").find("--poisson"), std::string::npos);
  EXPECT_NE(text("help animate").find("--poisson"), std::string::npos);
}

/// Each option of each command is in the manual and in the completions.
TEST_F(HelpText, ManualAndCompletionsHaveEveryOption) {
  std::string manual = text("help man");
  manual = std::regex_replace(manual, std::regex(R"(\\-)"), "-");
  const std::string bash = text("help bash");
  const std::string zsh = text("help zsh");
  const std::string fish = text("help fish");
  static const std::regex kOption("\n +(?:-[a-z],)?--([a-z][a-z-]+)");
  int count = 0;
  for (const std::string& command : kCommands) {
    const std::size_t section = manual.find(".SS sprung " + command + "\n");
    ASSERT_NE(section, std::string::npos) << command;
    const std::string help = text("help " + command);
    for (auto match = std::sregex_iterator(help.begin(), help.end(), kOption); match != std::sregex_iterator();
         ++match) {
      const std::string option = (*match)[1];
      ++count;
      EXPECT_NE(manual.find("--" + option, section), std::string::npos) << command << " " << option;
      EXPECT_TRUE(command == "help" || bash.find("--" + option) != std::string::npos) << command << " " << option;
      EXPECT_NE(zsh.find("*--" + option + "["), std::string::npos) << command << " " << option;
      EXPECT_NE(fish.find("_from " + command + "' -l " + option + " "), std::string::npos) << command << " " << option;
    }
  }
  EXPECT_GT(count, 80);
}

TEST_F(HelpText, AMistypedWordGetsTheNearest) {
  static_cast<void>(folder_.write("cube.obj", kCubeObj));
  EXPECT_NE(error("anmate cube.obj -o out").find("unknown command 'anmate'; did you mean 'animate'?"),
            std::string::npos);
  EXPECT_NE(error("animate cube.obj --brisks 3 -o out").find("did you mean '--bricks'?"), std::string::npos);
  EXPECT_NE(error("animate cube.obj -o out --material stel").find("did you mean 'steel'?"), std::string::npos);
  EXPECT_NE(error("animate cube.obj -o out --set body.sise=1").find("did you mean 'size'?"), std::string::npos);
  EXPECT_NE(error("animate cbue.obj -o out").find("did you mean 'cube.obj'?"), std::string::npos);
  EXPECT_EQ(error("--quiet animate cube.obj -o out"),
            "sprung: error: --quiet comes after the command: sprung animate --quiet\n");
  EXPECT_NE(error("simulate cube.obj -o run.h6").find("'.h6' files cannot be written; did you mean '.h5'?"),
            std::string::npos);
  EXPECT_NE(error("render cube.obj -o out").find("sprung animate draws a mesh"), std::string::npos);
  EXPECT_NE(error("compare cbe.obj cube.obj").find("no such file; did you mean 'cube.obj'?"), std::string::npos);
  EXPECT_NE(error("help anmate").find("did you mean 'animate'?"), std::string::npos);
  EXPECT_NE(error("validate --case cantilver").find("did you mean 'cantilever'?"), std::string::npos);
}

TEST_F(HelpText, LogJsonIsAnObjectALine) {
  static_cast<void>(folder_.write("cube.obj", kCubeObj));
  const std::string log = error("simulate cube.obj -o out --bricks 6 --duration 0.2 --log-json");
  static const std::regex kLine(R"re(\{"kind":"(note|warning|progress|stage|frame)",".*\}\n)re");
  EXPECT_EQ(std::regex_replace(log, kLine, ""), "");
  EXPECT_NE(log.find(R"({"kind":"progress","stage":"simulate","share":0.0,)"), std::string::npos) << log;
  EXPECT_NE(log.find(R"({"kind":"stage","stage":"simulate","seconds":)"), std::string::npos) << log;
  EXPECT_NE(error("simulate cbe.obj -o other --log-json").find("cbe.obj: no such file; did you mean 'cube.obj'?\"}"),
            std::string::npos);
  EXPECT_EQ(error("simulate --log-json --brik").find(R"({"kind":"error",)"), 0U);
}

}  // namespace
}  // namespace sprung
