#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

/// Every type has a name of its own. Two of one name in one namespace are one to the linker, whichever it meets first,
/// and no compiler says so: no file need include both.
namespace sprung {
namespace {

namespace fs = std::filesystem;

/// With their namespace; those at the margin of a file, where other files can see them.
std::vector<std::string> types_defined_in(std::istream& file) {
  static const std::regex kDefinition(R"re(^(?:struct|class|enum class|union) (\w+)(?: final)?(?: [:{].*)?$)re");
  static const std::regex kNamespace(R"re(^namespace ([\w:]+) \{$)re");
  std::vector<std::string> names;
  std::string space;
  bool is_hidden = false;
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (line == "namespace {") is_hidden = true;
    if (line == "}  // namespace") is_hidden = false;
    if (std::regex_match(line, match, kNamespace)) space = match[1];
    if (!is_hidden && std::regex_match(line, match, kDefinition)) names.push_back(space + "::" + match[1].str());
  }
  return names;
}

TEST(Names, EveryTypeHasItsOwn) {
  std::map<std::string, std::string> file_of;
  for (const char* layer : {"core", "render", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPRUNG_SOURCE_DIR) / layer)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      const std::string path = fs::relative(entry.path(), SPRUNG_SOURCE_DIR);
      for (const std::string& name : types_defined_in(file)) {
        const auto [known, is_new] = file_of.emplace(name, path);
        EXPECT_TRUE(is_new) << name << " is defined in " << known->second << " and in " << path;
      }
    }
  }
  EXPECT_GT(file_of.size(), 100U);
}

TEST(Names, DefinitionsAreSeen) {
  std::istringstream text(
      "namespace a::b {\nstruct A {\nclass B;\nclass C final : public D {\nenum class E { kOne };\nstruct F::G "
      "{\nnamespace {\nstruct H "
      "{\n"
      "}  // namespace\n  struct I {\nunion J {\nstruct K {};\n");
  EXPECT_EQ(types_defined_in(text), (std::vector<std::string>{"a::b::A", "a::b::C", "a::b::E", "a::b::J", "a::b::K"}));
}

}  // namespace
}  // namespace sprung
