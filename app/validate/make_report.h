#pragma once
#include <filesystem>
#include <vector>

#include "app/console.h"
#include "app/validate/check.h"
#include "app/validate/experiment_files.h"

namespace sprung {

/// Writes report.html into the folder: the checks, a picture of every experiment on a middling grid, and the plots.
/// `seconds` that the checks took. Throws Error(kFailed), Interrupted.
void make_report(const std::filesystem::path& folder, const std::vector<NamedScene>& experiments,
                 const std::vector<Check>& checks, double seconds, const Console& console);

}  // namespace sprung
