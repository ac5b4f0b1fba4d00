#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace sprung {

/// "1 triangle", "2 triangles"; `things` where the plural is not the thing with an s.
[[nodiscard]] inline std::string count_of(long count, std::string_view thing, std::string_view things = "") {
  if (count == 1) return fmt::format("1 {}", thing);
  if (things.empty()) return fmt::format("{} {}s", count, thing);
  return fmt::format("{} {}", count, things);
}

}  // namespace sprung
