#pragma once
#include <string>
#include <tuple>
#include <vector>

#include "app/scene/toml.h"

namespace sprung {

/// Everything that is wrong with a scene file, each with its place.
class SceneMistakes {
 public:
  explicit SceneMistakes(std::string file) : file_(std::move(file)) {}

  void add(const toml::source_region& place, std::string text);

  /// One Error(kBadInput) with a line "file:line:column: text" for each, in their order in the file.
  void throw_if_any();

 private:
  std::string file_;
  std::vector<std::tuple<toml::source_index, toml::source_index, std::string>> list_;
};

}  // namespace sprung
