#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/console/console.h"
#include "app/scene/film.h"
#include "app/validate/built_in_cases.h"

namespace sprung {

/// A case that was run: a scene or one that is built in.
struct FinishedCase {
  std::string name{};
  CaseResult result{};
  const Film* scene = nullptr;
  const BuiltInCase* built_in = nullptr;
};

/// Writes report.html into the folder: the checks, tables, a picture of every case on a middling grid, and the plots,
/// those too as files of their own. `seconds` that the checks took. Throws Error(kFailed), Interrupted.
void make_report(const std::filesystem::path& folder, const std::vector<FinishedCase>& cases, double seconds,
                 const Console& console);

}  // namespace sprung
