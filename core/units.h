#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// The dimension of a quantity, which determines its units.
enum class Dimension {
  kNone,
  kRatio,
  kLength,
  kTime,
  kRate,
  kPressure,
  kDensity,
  kSpeed,
  kAcceleration,
  kForce,
  kMass,
  kForceDensity,
  kTorque,
  kAngle,
  kTurning
};

/// The quantity written as "3 cm", "3cm" or "0.03" in the base unit of its dimension: SI, degrees for angles. A bare
/// number is in the base unit already. Throws Error(kBadInput) naming the text and the accepted units.
[[nodiscard]] double parse_quantity(std::string_view text, Dimension dimension);

/// m, of a unit of length alone: "mm". Throws Error(kUsage) naming the option --unit.
[[nodiscard]] double metres_in(std::string_view unit);

/// A whole number. Throws Error(kBadInput).
[[nodiscard]] int parse_whole(std::string_view text);

/// The units of a dimension, the base unit first; none for plain numbers.
[[nodiscard]] std::vector<std::string_view> units_of(Dimension dimension);

/// "m", "Pa", "degrees" ...; empty for plain numbers.
[[nodiscard]] std::string_view base_unit(Dimension dimension);

/// "0.03 m", "0.45": the value with its base unit.
[[nodiscard]] std::string with_unit(double value, Dimension dimension);

/// The value in the largest of the usual units that keeps it at 1 or above: "24 kPa", "1.5 cm", "210 GPa".
[[nodiscard]] std::string readable(double value, Dimension dimension);

/// "12 s", "3 min 05 s", "2 h 10 min", "5 days", "12 years".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace sprung
