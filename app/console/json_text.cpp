#include "app/console/json_text.h"

#include <fmt/format.h>

#include <cmath>

namespace sprung {

std::string json_text(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string json_text(const Vec3& value) {
  return fmt::format("[{}, {}, {}]", json_text(value.x()), json_text(value.y()), json_text(value.z()));
}

std::string json_text(std::string_view value) {
  std::string text = "\"";
  for (const char letter : value) {
    if (letter == '"' || letter == '\\') text += '\\';
    if (static_cast<unsigned char>(letter) < 0x20) {
      text += fmt::format("\\u{:04x}", unsigned(letter));
    } else {
      text += letter;
    }
  }
  return text + '"';
}

}  // namespace sprung
