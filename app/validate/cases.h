#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/validate/check.h"
#include "core/simulation/observer.h"
#include "render/body_picture.h"

namespace sprung {

/// A picture of a case, for the report.
struct CasePicture {
  BodyPicture picture{};
  std::string caption{};
};

/// A case of `sprung validate`.
struct Case {
  std::string name{};
  std::string title{};  // one line
  std::string about{};  // a paragraph for the report
  /// No checks if the case does not cover the choice.
  std::function<CaseResult(const Choice& choice, const Observer& observer)> run{};
  std::function<CasePicture()> draw{};  // empty: no picture
};

/// The cases that are not scenes. A new one is a function and an entry here.
[[nodiscard]] std::span<const Case> built_in_cases();

/// The case of a scene file, named after it. Runs the scene with every model, Poisson's ratio and grid of its
/// experiment and compares with its expectations. Checks of runs that fail measure NaN and say why. Throws
/// Error(kBadInput) if the scene is wrong or expects nothing; running it throws also if it expects a quantity that it
/// does not have.
[[nodiscard]] Case scene_case(const std::filesystem::path& file);

/// The cases of these names or scene files, scenes first; all that come with the program if there are no words. Throws
/// Error(kUsage) with the nearest name, Error(kBadInput) for a scene without expectations, Error(kFailed) if the folder
/// of the program's scenes is missing.
[[nodiscard]] std::vector<Case> find_cases(const std::vector<std::string>& words);

/// The names of all cases that come with the program; without the scenes if their folder is missing.
[[nodiscard]] std::vector<std::string> case_names();

/// Built-in cases.
[[nodiscard]] CaseResult run_patch(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_patch(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_stretch(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_shear(const Choice& choice);
[[nodiscard]] CaseResult run_membrane_cantilever(const Choice& choice);
[[nodiscard]] CaseResult run_equations(const Choice& choice);
[[nodiscard]] CaseResult run_uniaxial(const Choice& choice);
[[nodiscard]] CaseResult run_tables(const Choice& choice, const Observer& observer);
[[nodiscard]] CaseResult run_cut(const Choice& choice, const Observer& observer);

[[nodiscard]] CasePicture draw_patch();
[[nodiscard]] CasePicture draw_membrane_stretch();
[[nodiscard]] CasePicture draw_membrane_shear();
[[nodiscard]] CasePicture draw_membrane_cantilever();

}  // namespace sprung
