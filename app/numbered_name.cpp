#include "app/numbered_name.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace sprung {
namespace {

/// The number of digits in "{:04}", "{:04d}", "{:4}", "{}", "{:d}"; -1 for anything else.
int digits_of(std::string_view inside) {
  if (inside.starts_with(':')) inside.remove_prefix(1);
  if (inside.ends_with('d')) inside.remove_suffix(1);
  if (inside.empty()) return 0;
  const bool is_number = std::all_of(inside.begin(), inside.end(), [](char c) { return c >= '0' && c <= '9'; });
  const int digits = is_number && inside.size() <= 2 ? std::stoi(std::string(inside)) : -1;
  return digits > 9 ? -1 : digits;
}

}  // namespace

std::filesystem::path NumberedName::file(int number) const {
  return folder / fmt::format("{}{:0{}}{}", before, number, digits, after);
}

bool has_number(std::string_view words) { return words.find_first_of("{}") != std::string_view::npos; }

NumberedName parse_numbered_name(std::string_view words, std::string_view examples) {
  const auto refuse = [&](std::string_view reason) {
    throw Error(ErrorKind::kUsage, fmt::format("--output {}: {}; {}", words, reason, examples));
  };
  const std::filesystem::path path(words);
  const std::string name = path.filename().string();
  const auto open = name.find('{');
  const auto close = name.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) {
    refuse("the number's place must stand in the file's name");
  }
  NumberedName numbered{.folder = path.parent_path(), .before = name.substr(0, open), .after = name.substr(close + 1)};
  numbered.digits = digits_of(std::string_view(name).substr(open + 1, close - open - 1));
  if (numbered.digits < 0) refuse("the number's place must look like {:04}");
  if (has_number(numbered.after)) refuse("a name has one number");
  return numbered;
}

}  // namespace sprung
