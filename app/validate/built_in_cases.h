#pragma once
#include <span>
#include <string_view>

#include "app/report/html_report.h"
#include "app/validate/case_result.h"

namespace sprung {

/// A case that is no scene: a body or a question that scenes do not know.
struct BuiltInCase {
  std::string_view name;
  std::string_view title;
  std::string_view about;                   // what the report says about it
  CaseResult (*run)(const Choice& choice);  // nothing where the case has no answer to the choice
  ReportPicture (*draw)();                  // null: there is nothing to see
};

/// Uniform strains of several bricks and of a membrane, the membrane's cantilever, the table of equations, large
/// strain.
[[nodiscard]] std::span<const BuiltInCase> built_in_cases();

/// The runs of those cases.
[[nodiscard]] CaseResult run_patch(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_patch(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_stretch(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_shear(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_cantilever(const Choice& choice);
[[nodiscard]] CaseResult run_equations(const Choice& choice);
[[nodiscard]] CaseResult run_uniaxial(const Choice& choice);

/// Their pictures.
[[nodiscard]] ReportPicture draw_patch();
[[nodiscard]] ReportPicture draw_membrane_stretch();
[[nodiscard]] ReportPicture draw_membrane_shear();
[[nodiscard]] ReportPicture draw_membrane_cantilever();

}  // namespace sprung
