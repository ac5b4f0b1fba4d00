#include "app/scene/scene_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/color_text.h"
#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr std::string_view kAxisNames = "xyz";

std::uint8_t hex_byte(std::string_view text, std::size_t at) {
  unsigned value = 0;
  const char* first = text.data() + at;
  const auto [end, error] = std::from_chars(first, first + 2, value, 16);
  if (error != std::errc{} || end != first + 2) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' is not a colour; write it as \"#rrggbb\"", text));
  }
  return static_cast<std::uint8_t>(value);
}

}  // namespace

void refuse_name(std::string_view thing, std::string_view name, const std::vector<std::string_view>& names) {
  throw Error(ErrorKind::kBadInput, fmt::format("there is no {} '{}'{}", thing, name, did_you_mean(name, names)));
}

std::string range_text(const KeyInfo& key) {
  const Range& range = key.range;
  const std::string low = with_unit(range.low, key.dimension);
  const std::string high = with_unit(range.high, key.dimension);
  const bool has_high = std::isfinite(range.high);
  if (!std::isfinite(range.low)) return fmt::format("{} {}", range.without_high ? "below" : "at most", high);
  std::string text = fmt::format("{} {}", range.without_low ? "above" : "at least", low);
  if (has_high) text += fmt::format(" and {} {}", range.without_high ? "below" : "at most", high);
  return text;
}

void check_range(double value, const KeyInfo& key) {
  const Range& range = key.range;
  const bool is_low = range.without_low ? value <= range.low : value < range.low;
  const bool is_high = range.without_high ? value >= range.high : value > range.high;
  if (!std::isfinite(value)) throw Error(ErrorKind::kBadInput, fmt::format("{} is not a finite number", value));
  if (is_low || is_high) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{} is out of range; it must be {}", with_unit(value, key.dimension), range_text(key)));
  }
  const auto is_value = [&](int choice) { return choice == value; };
  if (!key.choices.empty() && std::none_of(key.choices.begin(), key.choices.end(), is_value)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{} is not one of {}", value, fmt::join(key.choices, ", ")));
  }
}

void parse_value(std::string_view text, const KeyInfo& key, double& value) {
  value = parse_quantity(text, key.dimension);
  check_range(value, key);
}

void parse_value(std::string_view text, const KeyInfo& key, int& value) {
  value = parse_whole(text);
  check_range(value, key);
}

void parse_value(std::string_view text, const KeyInfo& key, std::array<int, 2>& value) {
  const bool has_brackets = text.starts_with('[') && text.ends_with(']');
  const std::string_view pair = has_brackets ? text.substr(1, text.size() - 2) : text;
  const auto border = pair.find_first_of("xX,");
  if (border == std::string_view::npos) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("'{}' is not a pair of whole numbers; write two, as in 1280x720 or [1280, 720]", text));
  }
  parse_value(pair.substr(0, border), key, value[0]);
  parse_value(pair.substr(border + 1), key, value[1]);
}

void parse_value(std::string_view text, const KeyInfo&, std::filesystem::path& value) {
  if (text.empty()) throw Error(ErrorKind::kBadInput, "is empty; name a file");
  if (text.find('\0') != std::string_view::npos)
    throw Error(ErrorKind::kBadInput, "a file name cannot contain a null character");
  value = text;
}

void parse_value(std::string_view text, const KeyInfo&, std::string& value) {
  if (text.empty()) throw Error(ErrorKind::kBadInput, "is empty");
  value = text;
}

void parse_value(std::string_view text, const KeyInfo&, Axes& value) {
  value.fixed = {false, false, false};
  for (const char letter : text) {
    const auto axis = kAxisNames.find(letter);
    if (axis == std::string_view::npos || value.fixed[axis]) {
      throw Error(ErrorKind::kBadInput, fmt::format("'{}' are not directions; write some of \"xyz\"", text));
    }
    value.fixed[axis] = true;
  }
  if (text.empty()) throw Error(ErrorKind::kBadInput, "must name at least one direction: some of \"xyz\"");
}

void parse_value(std::string_view text, const KeyInfo&, bool& value) {
  const bool is_true = text == "true" || text == "on";
  if (!is_true && text != "false" && text != "off") {
    throw Error(ErrorKind::kBadInput, fmt::format("must be true or false, not '{}'", text));
  }
  value = is_true;
}

void parse_value(std::string_view text, const KeyInfo& key, BrickCount& value) {
  value.along = 0;
  if (text != "auto") parse_value(text, key, value.along);
}

void parse_value(std::string_view text, const KeyInfo&, Model& value) { value = model_from_name(text); }

void parse_value(std::string_view text, const KeyInfo&, Color& value) {
  if (text.size() != 7 || text[0] != '#') {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' is not a colour; write it as \"#rrggbb\"", text));
  }
  value = {.red = hex_byte(text, 1), .green = hex_byte(text, 3), .blue = hex_byte(text, 5)};
}

/// Without a sign before 0, which TOML would read as the whole number 0.
std::string toml_text(double value) { return fmt::format("{}", value + 0.0); }
std::string toml_text(bool value) { return value ? "true" : "false"; }

std::string toml_text(int value) { return fmt::format("{}", value); }
std::string toml_text(const BrickCount& value) {
  return value.is_auto() ? toml_text(std::string_view("auto")) : toml_text(value.along);
}
std::string toml_text(const Vec3& value) {
  return fmt::format("[{}, {}, {}]", toml_text(value.x()), toml_text(value.y()), toml_text(value.z()));
}
std::string toml_text(const std::array<int, 2>& value) { return fmt::format("[{}, {}]", value[0], value[1]); }
std::string toml_text(const std::array<int, 3>& value) { return fmt::format("[{}]", fmt::join(value, ", ")); }

std::string toml_text(std::string_view value) {
  std::string text = "\"";
  for (const char letter : value) {
    if (letter == '"' || letter == '\\') text += '\\';
    if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
      text += fmt::format("\\u{:04x}", unsigned(letter));
    } else {
      text += letter;
    }
  }
  return text + '"';
}

std::string toml_text(const std::string& value) { return toml_text(std::string_view(value)); }
std::string toml_text(const std::filesystem::path& value) { return toml_text(std::string_view(value.native())); }
std::string toml_text(Model value) { return toml_text(model_name(value)); }

std::string toml_text(const Axes& value) {
  std::string names;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (value.fixed[axis]) names += kAxisNames[axis];
  }
  return toml_text(std::string_view(names));
}

std::string toml_text(const Color& value) { return toml_text(hex_text(value)); }

}  // namespace sprung
