#pragma once
#include <optional>
#include <string>

#include "app/load/part_answer.h"
#include "app/scene/material_library.h"

namespace sprung {

/// Limits that a part must meet; none: not requested.
struct PartLimits {
  std::optional<double> displacement;  // m
  std::optional<double> safety;        // strength over stress
};

/// Says whether a part meets its limits.
struct PartVerdict {
  bool holds = true;
  std::optional<double> safety;  // strength over the largest stress away from singularities; none: one is unknown
  double min_safety = 0;         // with the error of the stress; both are `safety` if it is unknown
  double max_safety = 0;         // likewise
  std::string strength;          // which: "yield strength"
  double strength_value = 0;     // Pa
};

/// Compares the von Mises stress with the yield strength or, if the material has none, the largest tension with the
/// ultimate strength. `material`: null if it is not in the library.
[[nodiscard]] PartVerdict judge(const PartAnswer& answer, const LibraryMaterial* material, const PartLimits& limits);

/// The contents of a report.
struct PartReport {
  const LoadPart& part;
  const LoadCase& loads;
  const PartAnswer& answer;
  const LibraryMaterial* material;
  const PartVerdict& verdict;
  const PartLimits& limits;
};

/// "1.9", or "1.9 (1.55 to 2.44)" where the error of the stress counts; for a verdict with a safety.
[[nodiscard]] std::string safety_text(const PartVerdict& verdict);

/// "80 mm x 60 mm x 30 mm".
[[nodiscard]] std::string sides_text(const Vec3& sides);

/// The report as text, JSON and CSV ("quantity,value,error,x,y,z"); the last two in SI units, positions in those of the
/// file.
[[nodiscard]] std::string text_of(const PartReport& report);
[[nodiscard]] std::string json_of(const PartReport& report);
[[nodiscard]] std::string csv_of(const PartReport& report);

}  // namespace sprung
