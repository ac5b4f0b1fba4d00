#pragma once
#include <string>
#include <string_view>

#include "app/sweep/sweep_table.h"
#include "app/validate/svg_plot.h"

namespace sprung {

/// A measurement of all runs over a swept key, one curve for each combination of the other swept values. `measured`
/// and `key` name columns without their units; an empty key: the first that was swept. Values that are not numbers are
/// placed at 1, 2, ... in the order of the runs. Throws Error(kUsage) naming the columns that there are.
[[nodiscard]] Figure sweep_figure(const SweepTable& table, std::string_view measured, std::string_view key);

/// The figure and the table as a self-contained page.
[[nodiscard]] std::string sweep_page(const SweepTable& table, const Figure& figure);

}  // namespace sprung
