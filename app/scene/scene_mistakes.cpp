#include "app/scene/scene_mistakes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace sprung {

void SceneMistakes::add(const toml::source_region& place, std::string text) {
  list_.emplace_back(place.begin.line, place.begin.column, std::move(text));
}

void SceneMistakes::throw_if_any() {
  if (list_.empty()) return;
  std::sort(list_.begin(), list_.end());
  std::vector<std::string> lines;
  for (const auto& [line, column, text] : list_)
    lines.push_back(fmt::format("{}:{}:{}: {}", file_, line, column, text));
  throw Error(ErrorKind::kBadInput, fmt::format("{}", fmt::join(lines, "\n")));
}

}  // namespace sprung
