#include "core/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace sprung {
namespace {

/// One way to write a quantity. `is_usual`: fit for messages.
struct Unit {
  Dimension dimension;
  std::string_view name;
  double value;  // in the base unit
  bool is_usual = false;
};

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

/// The first unit of a dimension is its base unit; usual units grow from there in the order of the table.
constexpr std::array<Unit, 83> kUnits{{
    {Dimension::kRatio, "", 1},
    {Dimension::kRatio, "%", 0.01},
    {Dimension::kLength, "m", 1, true},
    {Dimension::kLength, "um", 1e-6, true},
    {Dimension::kLength, "µm", 1e-6},
    {Dimension::kLength, "mm", 1e-3, true},
    {Dimension::kLength, "cm", 1e-2, true},
    {Dimension::kLength, "dm", 0.1},
    {Dimension::kLength, "km", 1e3},
    {Dimension::kLength, "in", 0.0254},
    {Dimension::kLength, "ft", 0.3048},
    {Dimension::kTime, "s", 1, true},
    {Dimension::kTime, "us", 1e-6, true},
    {Dimension::kTime, "µs", 1e-6},
    {Dimension::kTime, "ms", 1e-3, true},
    {Dimension::kTime, "min", 60},
    {Dimension::kTime, "h", 3600},
    {Dimension::kRate, "fps", 1, true},
    {Dimension::kRate, "Hz", 1},
    {Dimension::kRate, "1/s", 1},
    {Dimension::kPressure, "Pa", 1, true},
    {Dimension::kPressure, "hPa", 1e2},
    {Dimension::kPressure, "kPa", 1e3, true},
    {Dimension::kPressure, "MPa", 1e6, true},
    {Dimension::kPressure, "GPa", 1e9, true},
    {Dimension::kPressure, "N/m2", 1},
    {Dimension::kPressure, "N/m^2", 1},
    {Dimension::kPressure, "N/mm2", 1e6},
    {Dimension::kPressure, "N/mm^2", 1e6},
    {Dimension::kPressure, "mbar", 1e2},
    {Dimension::kPressure, "bar", 1e5},
    {Dimension::kPressure, "psi", 6894.757293168361},
    {Dimension::kPressure, "ksi", 6894757.293168361},
    {Dimension::kDensity, "kg/m3", 1, true},
    {Dimension::kDensity, "kg/m^3", 1},
    {Dimension::kDensity, "kg/m³", 1},
    {Dimension::kDensity, "g/cm3", 1e3},
    {Dimension::kDensity, "g/cm^3", 1e3},
    {Dimension::kDensity, "g/cm³", 1e3},
    {Dimension::kDensity, "g/ml", 1e3},
    {Dimension::kDensity, "kg/l", 1e3},
    {Dimension::kDensity, "t/m3", 1e3},
    {Dimension::kDensity, "t/m^3", 1e3},
    {Dimension::kDensity, "lb/ft3", 16.018463373960142},
    {Dimension::kDensity, "lb/ft^3", 16.018463373960142},
    {Dimension::kSpeed, "m/s", 1, true},
    {Dimension::kSpeed, "mm/s", 1e-3},
    {Dimension::kSpeed, "cm/s", 1e-2},
    {Dimension::kSpeed, "km/h", 1 / 3.6},
    {Dimension::kSpeed, "mph", 0.44704},
    {Dimension::kAcceleration, "m/s2", 1, true},
    {Dimension::kAcceleration, "m/s^2", 1},
    {Dimension::kAcceleration, "m/s²", 1},
    {Dimension::kAcceleration, "cm/s2", 1e-2},
    {Dimension::kAcceleration, "g", 9.80665},
    {Dimension::kForce, "N", 1, true},
    {Dimension::kForce, "mN", 1e-3, true},
    {Dimension::kForce, "kN", 1e3, true},
    {Dimension::kForce, "kgf", 9.80665},
    {Dimension::kForce, "lbf", 4.4482216152605},
    {Dimension::kMass, "kg", 1, true},
    {Dimension::kMass, "mg", 1e-6, true},
    {Dimension::kMass, "g", 1e-3, true},
    {Dimension::kMass, "t", 1e3},
    {Dimension::kMass, "lb", 0.45359237},
    {Dimension::kTorque, "N m", 1, true},
    {Dimension::kTorque, "Nm", 1},
    {Dimension::kTorque, "N mm", 1e-3},
    {Dimension::kTorque, "Nmm", 1e-3},
    {Dimension::kTorque, "mN m", 1e-3, true},
    {Dimension::kTorque, "kN m", 1e3, true},
    {Dimension::kForceDensity, "N/m3", 1, true},
    {Dimension::kForceDensity, "N/m^3", 1},
    {Dimension::kForceDensity, "kN/m3", 1e3, true},
    {Dimension::kAngle, "degrees", 1, true},
    {Dimension::kAngle, "deg", 1},
    {Dimension::kAngle, "°", 1},
    {Dimension::kAngle, "rad", kDegreesPerRadian},
    {Dimension::kTurning, "degrees/s", 1, true},
    {Dimension::kTurning, "deg/s", 1},
    {Dimension::kTurning, "°/s", 1},
    {Dimension::kTurning, "rad/s", kDegreesPerRadian},
    {Dimension::kTurning, "rpm", 6},
}};

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string expected(Dimension dimension) {
  const std::vector<std::string_view> units = units_of(dimension);
  if (units.empty()) return "a number";
  return fmt::format("a number, alone{} or with one of {}",
                     base_unit(dimension).empty() ? "" : fmt::format(" ({})", base_unit(dimension)),
                     fmt::join(units, ", "));
}

[[noreturn]] void refuse(std::string_view text, std::string_view reason, Dimension dimension) {
  throw Error(ErrorKind::kBadInput, fmt::format("'{}' {}; give {}", text, reason, expected(dimension)));
}

double unit_value(std::string_view text, std::string_view name, Dimension dimension) {
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension && unit.name == name) return unit.value;
  }
  if (dimension == Dimension::kNone) refuse(text, "takes no unit", dimension);
  if (name.starts_with(',')) refuse(text, "has a comma where the decimal point goes", dimension);
  refuse(text, fmt::format("has the unknown unit '{}'", name), dimension);
}

}  // namespace

std::vector<std::string_view> units_of(Dimension dimension) {
  std::vector<std::string_view> names;
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension && !unit.name.empty()) names.push_back(unit.name);
  }
  return names;
}

double parse_quantity(std::string_view text, Dimension dimension) {
  std::string_view rest = trim(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range) refuse(text, "is out of range", dimension);
  if (error != std::errc{} || !std::isfinite(number)) refuse(text, "is no number", dimension);
  rest = trim(rest.substr(end - rest.data()));
  return rest.empty() ? number : number * unit_value(text, rest, dimension);
}

double metres_in(std::string_view unit) {
  const std::vector<std::string_view> known = units_of(Dimension::kLength);
  if (std::find(known.begin(), known.end(), unit) != known.end()) return unit_value(unit, unit, Dimension::kLength);
  throw Error(ErrorKind::kUsage,
              fmt::format("--unit: '{}' is no unit of length; known are {}", unit, fmt::join(known, ", ")));
}

int parse_whole(std::string_view text) {
  const std::string_view digits = trim(text);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' is not a whole number", text));
  }
  return number;
}

std::string_view base_unit(Dimension dimension) {
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension) return unit.name;
  }
  return "";
}

std::string with_unit(double value, Dimension dimension) {
  const std::string_view unit = base_unit(dimension);
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::string readable(double value, Dimension dimension) {
  const Unit* best = nullptr;
  for (const Unit& unit : kUnits) {
    if (unit.dimension != dimension || !unit.is_usual) continue;
    const bool fits = std::abs(value) >= unit.value * (1 - 1e-9);
    const bool best_fits = best != nullptr && std::abs(value) >= best->value * (1 - 1e-9);
    const bool is_better =
        best == nullptr || (fits ? !best_fits || unit.value > best->value : !best_fits && unit.value < best->value);
    if (is_better) best = &unit;
  }
  if (best == nullptr) return with_unit(value, dimension);
  return fmt::format("{:.4g} {}", value / best->value, best->name);
}

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  if (whole < 3 * 86400) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  return whole < 3 * 365 * 86400L ? fmt::format("{} days", whole / 86400)
                                  : fmt::format("{} years", whole / (365 * 86400L));
}

}  // namespace sprung
