#pragma once
#include <fmt/format.h>

#include <string>

#include "core/appearance.h"

namespace sprung {

/// "#rrggbb"
[[nodiscard]] inline std::string hex_text(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

}  // namespace sprung
