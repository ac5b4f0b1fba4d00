#pragma once
#include <optional>
#include <string>

#include "app/load/part_answer.h"
#include "app/scene/material_library.h"

namespace sprung {

/// What a part must not exceed; none: nothing was asked for.
struct PartLimits {
  std::optional<double> displacement;  // m
  std::optional<double> safety;        // strength over stress
};

/// Whether it does.
struct PartVerdict {
  bool holds = true;
  std::optional<double> safety;  // strength over the largest stress away from singular places; none: one is unknown
  std::string strength;          // which: "yield strength"
  double strength_value = 0;     // Pa
};

/// By von Mises stress against the yield strength; where the material has none, by the largest tension against the
/// ultimate strength. `material`: null where it is none of the library.
[[nodiscard]] PartVerdict judge(const PartAnswer& answer, const LibraryMaterial* material, const PartLimits& limits);

/// All that a report says.
struct PartReport {
  const LoadPart& part;
  const LoadCase& loads;
  const PartAnswer& answer;
  const LibraryMaterial* material;
  const PartVerdict& verdict;
  const PartLimits& limits;
};

/// "80 mm x 60 mm x 30 mm".
[[nodiscard]] std::string sides_text(const Vec3& sides);

/// For a person, as JSON and as CSV ("quantity,value,error,x,y,z"); the last two in SI units, places in those of the
/// file.
[[nodiscard]] std::string text_of(const PartReport& report);
[[nodiscard]] std::string json_of(const PartReport& report);
[[nodiscard]] std::string csv_of(const PartReport& report);

}  // namespace sprung
