#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

/// Every folder has a position in the order, and includes only folders before it.
namespace sprung {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kFolders{
    "core",
    "core/mesh",
    "core/mesh/query",
    "core/mesh/repair",
    "core/mesh/io",
    "core/bricks",
    "core/law",
    "core/law/solid",
    "core/body/kernel",
    "core/body",
    "core/skin",
    "core/world",
    "core/contact/search",
    "core/contact/watch",
    "core/contact/pairs",
    "core/contact",
    "core/dynamics",
    "core/dynamics/linear",
    "core/dynamics/statics",
    "core/dynamics/explicit",
    "core/dynamics/implicit",
    "core/io",
    "core/simulation",
    "render/image",
    "render/gl",
    "render/stage",
    "render/trace",
    "render",
    "app/console",
    "app/scene",
    "app/validate",
    "app/film",
    "app/sweep",
    "app/export",
    "app/load",
    "app/inspect",
    "app/help",
    "app/commands",
    "app/python",
    "app",
};

struct Include {
  std::string from;  // path below the top folder
  std::string to;
};

std::vector<Include> includes_of(const fs::path& top) {
  static const std::regex kLine(R"re(^\s*#include\s+"([^"]+)")re");
  std::vector<Include> includes;
  for (const char* layer : {"core", "render", "app"}) {
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

/// The position of a file's folder in the order; -1 if it is not in it.
int rank(const std::string& file) {
  const std::string folder = fs::path(file).parent_path();
  const auto found = std::find(kFolders.begin(), kFolders.end(), folder);
  return found == kFolders.end() ? -1 : int(found - kFolders.begin());
}

/// Empty if the include is allowed, else what is wrong with it.
std::string fault(const Include& include) {
  const int from = rank(include.from);
  const int to = rank(include.to);
  if (from < 0) return include.from + ": its folder has no place in the order of folders";
  if (to < 0) return include.from + " includes \"" + include.to + "\": its folder has no place in the order of folders";
  return to > from ? include.from + " includes " + include.to + ": against the order of folders" : "";
}

TEST(Layers, NoIncludeGoesAgainstTheDirection) {
  const std::vector<Include> includes = includes_of(SPRUNG_SOURCE_DIR);
  EXPECT_GT(includes.size(), 50U);
  for (const Include& include : includes) EXPECT_EQ(fault(include), "");
}

TEST(Layers, FaultsAreSeen) {
  EXPECT_EQ(fault({"app/main.cpp", "core/error.h"}), "");
  EXPECT_EQ(fault({"core/body/body.h", "core/bricks/brick_grid.h"}), "");
  EXPECT_NE(fault({"core/body/body.h", "render/image/image.h"}), "");
  EXPECT_NE(fault({"render/film.cpp", "app/scene/scene.h"}), "");
  EXPECT_NE(fault({"core/bricks/brick_grid.h", "core/body/body.h"}), "");
  EXPECT_NE(fault({"core/bricks/brick_grid.cpp", "brick_grid.h"}), "");
  EXPECT_NE(fault({"core/anywhere/else.h", "core/error.h"}), "");
}

}  // namespace
}  // namespace sprung
