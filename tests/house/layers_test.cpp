#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

/// The house has a direction: app -> render -> core, and inside core data flows one way.
namespace sprung {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kLayers{"core", "render", "app"};
const std::vector<std::string> kStages{"mesh", "bricks", "law", "body", "world", "motion", "skin", "output"};

struct Include {
  std::string from;  // path below the top folder
  std::string to;
};

std::vector<Include> includes_of(const fs::path& top) {
  static const std::regex kLine(R"re(^\s*#include\s+"([^"]+)")re");
  std::vector<Include> includes;
  for (const std::string& layer : kLayers) {
    for (const auto& entry : fs::recursive_directory_iterator(top / layer)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      std::smatch match;
      for (std::string line; std::getline(file, line);) {
        if (std::regex_search(line, match, kLine)) includes.push_back({fs::relative(entry.path(), top), match[1]});
      }
    }
  }
  return includes;
}

/// Where the nth folder of a path stands in an order; -1 where it is not one of them.
int rank(const std::vector<std::string>& order, const std::string& path, int nth) {
  const fs::path whole(path);
  auto folder = whole.begin();
  for (int i = 0; i < nth && folder != whole.end(); ++i) ++folder;
  if (folder == whole.end()) return -1;
  const auto found = std::find(order.begin(), order.end(), folder->string());
  return found == order.end() ? -1 : static_cast<int>(found - order.begin());
}

/// Empty where the include is allowed, else what is wrong with it.
std::string fault(const Include& include) {
  const int from = rank(kLayers, include.from, 0);
  const int to = rank(kLayers, include.to, 0);
  if (to < 0) return include.from + " includes \"" + include.to + "\": not a path below core, render or app";
  if (to > from) return include.from + " includes " + include.to + ": against app -> render -> core";
  if (from > 0 || to > 0) return "";
  const int from_stage = rank(kStages, include.from, 1);
  const int to_stage = rank(kStages, include.to, 1);
  if (from_stage < 0 || to_stage <= from_stage) return "";
  return include.from + " includes " + include.to + ": against the flow of core's stages";
}

TEST(Layers, NoIncludeGoesAgainstTheDirection) {
  const std::vector<Include> includes = includes_of(SPRUNG_SOURCE_DIR);
  EXPECT_GT(includes.size(), 50U);
  for (const Include& include : includes) EXPECT_EQ(fault(include), "");
}

TEST(Layers, FaultsAreSeen) {
  EXPECT_EQ(fault({"app/main.cpp", "core/error.h"}), "");
  EXPECT_EQ(fault({"core/body/body.h", "core/bricks/brick_grid.h"}), "");
  EXPECT_NE(fault({"core/body/body.h", "render/image.h"}), "");
  EXPECT_NE(fault({"render/png.cpp", "app/scene/scene.h"}), "");
  EXPECT_NE(fault({"core/bricks/brick_grid.h", "core/body/body.h"}), "");
  EXPECT_NE(fault({"core/bricks/brick_grid.cpp", "brick_grid.h"}), "");
}

}  // namespace
}  // namespace sprung
