#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// The words of the house. Every type has a name of its own: two of one name in one namespace are one to the linker,
/// which keeps the first it meets, and no compiler reports it, since no file need include both. And sources and
/// documentation use the field's word for each thing.
namespace sprung {
namespace {

namespace fs = std::filesystem;

/// Their names with namespace; only types at namespace scope, where other files can see them.
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

/// What was once written, and what the field says.
const std::vector<std::pair<std::string, std::string>> kWords{
    {"actors?", "body"},  // the cache's folders keep their names: /actors/1
    {"HeldNode|held_nodes", "KinematicNode"},
    {"Squeeze\\w*|squeeze_\\w+", "inversion"},
    {"SkinStance|nearest_stance", "PointTriangleContact, closest_triangle"},
    {"SkinPairs|near_skins", "ContactCandidates, broad_phase"},
    {"start_from_before", "warm_start"},
    {"look_ahead", "predict, extrapolate"},
    {"Grip|grip", "friction"},
    {"CarefulMotion", "AdaptiveIntegrator"},
    {"MotionMemory", "IntegratorState"},
    {"energy_from_nowhere|[Ee]nergy from nowhere", "energy gain"},
    {"why_not_implicit", "check_implicit_support"},
    {"\\w+_hardness", "stiffness"},
    {"Mender|mended?|mending", "repair"},
    {"mix_at_points", "interpolate"},
    {"bound_answers", "compute_row_sums"},
    {"longest_stride", "max_step_size"},
    {"free_way", "cast_ray"},
    {"few_words", "summary"},
    {"gone_direct|will_do|WillDo", "fallbacks, fallback_tolerance"},
    {"Pushed", "SolverNode, JacobianEntry"},
    {"dear|dearer", "expensive"},
    {"[Hh]angs? together|hung together", "connected"},
    {"finds? no end|comes? to no end", "does not converge"},
    {"may touch whom", "contact groups"},
    {"no trouble pass", "retries"},
    {"quick system", "default linear solver"},
    {"cut in halves|made again in halves", "retried with half the step"},
    {"clean boundary", "defective mesh"},
    {"kMost[A-Z]\\w*|kLeast[A-Z]\\w*", "kMax, kMin"},
    {"place_of", "position_of, slot_of, location_of"},
    {"\\w*Mover", "stepper"},
    {"nothing holds", "no support"},
    {"know nothing of", "do not support"},
    {"done again in", "repeated with"},
    {"hold more of", "support more of"},
};

struct WordFound {
  int line;
  std::string word;
  std::string field;
};

std::vector<WordFound> words_to_change(std::istream& file) {
  static const std::vector<std::pair<std::regex, std::string>> kPatterns = [] {
    std::vector<std::pair<std::regex, std::string>> patterns;
    for (const auto& [word, field] : kWords) patterns.emplace_back("(?:^|[^/\\w])(" + word + ")\\b", field);
    return patterns;
  }();
  std::vector<WordFound> found;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    std::smatch match;
    for (const auto& [pattern, field] : kPatterns) {
      if (std::regex_search(line, match, pattern)) found.push_back({number, match[1], field});
    }
  }
  return found;
}

TEST(Names, AreTheWordsOfTheField) {
  int count = 0;
  for (const char* folder : {"core", "render", "app", "tests", "assets/docs"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPRUNG_SOURCE_DIR) / folder)) {
      const std::string kind = entry.path().extension();
      if (kind != ".h" && kind != ".cpp" && kind != ".py" && kind != ".md") continue;
      if (entry.path().filename() == "names_test.cpp") continue;
      std::ifstream file(entry.path());
      for (const WordFound& found : words_to_change(file)) {
        ADD_FAILURE() << fs::relative(entry.path(), SPRUNG_SOURCE_DIR).string() << ":" << found.line << ": '"
                      << found.word << "' is not the field's word; say: " << found.field;
      }
      ++count;
    }
  }
  EXPECT_GT(count, 500);
}

TEST(Names, WordsAreSeen) {
  std::istringstream text("int factor = 1;\n// An actor.\nread(\"/actors/1\");\nparts hang together\n");
  const std::vector<WordFound> found = words_to_change(text);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].line, 2);
  EXPECT_EQ(found[0].word, "actor");
  EXPECT_EQ(found[1].word, "hang together");
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
