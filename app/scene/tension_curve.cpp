#include "app/scene/tension_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr std::string_view kExample = "a line is a stretch and a nominal stress, like 1.5, 20 kPa";

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return text;
}

/// The two columns of a line; the second is empty if there is one only.
std::array<std::string_view, 2> columns_of(std::string_view line) {
  std::size_t end = line.find_first_of(",;");
  if (end == std::string_view::npos) end = line.find_first_of(" \t");
  if (end == std::string_view::npos) return {line, {}};
  return {trimmed(line.substr(0, end)), trimmed(line.substr(end + 1))};
}

/// The unit at the end of a head, as in "stress_MPa", "stress (kPa)" and "stress [kPa]"; empty: none.
std::string unit_of_head(std::string_view name) {
  while (!name.empty() && (name.back() == ')' || name.back() == ']')) name.remove_suffix(1);
  const std::size_t start = name.find_last_of("_([ ");
  return start == std::string_view::npos ? "" : std::string(name.substr(start + 1));
}

bool is_number(std::string_view text) {
  return !text.empty() && (std::isdigit(static_cast<unsigned char>(text.front())) != 0 || text.front() == '.' ||
                           text.front() == '-' || text.front() == '+');
}

/// Pa.
double stress_of(std::string_view text, double unit) {
  const bool has_unit = std::any_of(text.begin(), text.end(), [](unsigned char c) { return c == 'P'; });
  const double value = parse_quantity(std::string(text), Dimension::kPressure);
  return has_unit ? value : unit * value;
}

}  // namespace

TensionCurve read_tension_curve(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(ErrorKind::kBadInput, fmt::format("cannot read the curve '{}'", file.string()));
  TensionCurve curve;
  double unit = 1;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const auto [first, second] = columns_of(text);
    const auto refuse = [&](std::string_view what) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}:{}: '{}': {}", file.string(), number, text, what));
    };
    try {
      if (!is_number(first) && curve.stretches.empty()) {
        const std::string named = unit_of_head(second);
        if (!named.empty()) unit = parse_quantity("1 " + named, Dimension::kPressure);
        continue;
      }
      curve.stretches.push_back(parse_quantity(std::string(first), Dimension::kNone));
      curve.stresses.push_back(stress_of(second, unit));
    } catch (const Error& error) {
      refuse(fmt::format("{}; {}", error.what(), kExample));
    }
    const double stretch = curve.stretches.back();
    const double stress = curve.stresses.back();
    if (!(stretch > 0.1 && stretch < 100)) {
      refuse("the stretch (length over rest length) must be from 0.1 to 100; a strain plus one is a stretch");
    }
    if ((stretch - 1) * stress < 0) {
      refuse("a stretch above 1 needs a stress above 0, one below 1 a stress below 0");
    }
  }
  return curve;
}

void fit_to_curve(Material& material, bool keeps_law) {
  const TensionCurve curve = read_tension_curve(material.curve);
  try {
    const CurveFit fit = fit_curve(curve, material.poisson, keeps_law ? &material.law.kind : nullptr);
    material.young = fit.young;
    material.law = fit.law;
    material.source = fit_text(fit, curve, material.curve);
  } catch (const Error& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", material.curve.string(), error.what()));
  }
}

std::string fit_text(const CurveFit& fit, const TensionCurve& curve, const std::filesystem::path& file) {
  const auto [low, high] = std::minmax_element(curve.stretches.begin(), curve.stretches.end());
  return fmt::format(
      "fitted to {} ({} points, stretch {:g} to {:g}): {:.2g} % off (root mean square), {:.2g} % at most",
      file.filename().string(), curve.stretches.size(), *low, *high, 100 * fit.error, 100 * fit.largest_error);
}

}  // namespace sprung
