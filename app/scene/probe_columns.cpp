#include "app/scene/probe_columns.h"

#include <fmt/format.h>

namespace sprung {

std::string column_name(std::string_view name, std::string_view unit) {
  std::string letters(unit);
  std::erase_if(letters, [](char letter) { return letter == ' ' || letter == '^'; });
  return fmt::format("{}{}{}", name, letters.empty() ? "" : "_", letters);
}

}  // namespace sprung
