#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// The long options that a text names.
std::set<std::string> options_in(const std::string& text) {
  static const std::regex kOption("--[a-z][a-z-]+");
  std::set<std::string> options;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), kOption); match != std::sregex_iterator(); ++match) {
    options.insert(match->str());
  }
  return options;
}

TEST(Documentation, ListsTheOptionsThatExist) {
  const std::string page = text_of(SPRUNG_SOURCE_DIR "/assets/docs/options.md");
  const std::size_t begin = page.find("## Options of `sprung animate`");
  const std::size_t end = page.find("Lengths, times", begin);
  ASSERT_NE(end, std::string::npos);
  const TempFolder folder;
  std::set<std::string> existing = options_in(run_program(folder, "help animate").out);
  existing.erase("--help");
  EXPECT_EQ(options_in(page.substr(begin, end - begin)), existing);
}

}  // namespace
}  // namespace sprung
