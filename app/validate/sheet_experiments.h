#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "app/validate/check.h"

namespace sprung {

/// An experiment on a flat sheet of rectangles, the paper's 2D element. A scene has no such body.
struct SheetExperiment {
  std::string_view name;
  std::string_view title;
  std::vector<Check> (*run)();
};

/// Stretch and shear (exact by theory) and the cantilever against beam theory.
[[nodiscard]] std::span<const SheetExperiment> sheet_experiments();

}  // namespace sprung
