#include "app/sweep/swept_values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"

namespace sprung {
namespace {

constexpr double kMaxValues = 10000;  // of a range

struct Number {
  double value;
  std::string unit;
};

std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  if (error != std::errc() || !std::isfinite(number.value)) return std::nullopt;
  number.unit = std::string(end, text.data() + text.size());
  return number;
}

/// First, last and step; none if the text is no range.
std::optional<std::array<Number, 3>> range_in(std::string_view text) {
  std::array<Number, 3> range;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto colon = text.find(':');
    if ((colon == std::string_view::npos) != (i == 2)) return std::nullopt;
    const std::optional<Number> number = number_in(text.substr(0, colon));
    if (!number || (i > 0 && number->unit != range[0].unit)) return std::nullopt;
    range[i] = *number;
    if (i < 2) text.remove_prefix(colon + 1);
  }
  return range;
}

/// Adds what a word without commas stands for.
void add_values(std::string_view word, std::vector<std::string>& values) {
  const std::optional<std::array<Number, 3>> range = range_in(word);
  if (!range) {
    values.emplace_back(word);
    return;
  }
  const auto& [first, last, step] = *range;
  const double steps = std::floor((last.value - first.value) / step.value + 1e-9);
  if (!(steps >= 0 && steps < kMaxValues)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--set: {}: a range is FIRST:LAST:STEP, with a step that leads from one to the other in at "
                            "most {} values",
                            word, kMaxValues));
  }
  for (int i = 0; i <= int(steps); ++i)
    values.push_back(fmt::format("{:.10g}{}", first.value + i * step.value, first.unit));
}

}  // namespace

std::vector<std::string> values_in(std::string_view text) {
  std::vector<std::string> values;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char letter = i < text.size() ? text[i] : ',';
    if (letter == '[' || letter == '{') ++depth;
    if (letter == ']' || letter == '}') --depth;
    if (letter != ',' || (depth != 0 && i < text.size())) continue;
    add_values(text.substr(begin, i - begin), values);
    begin = i + 1;
  }
  return values;
}

}  // namespace sprung
