#pragma once
#include <string>
#include <vector>

#include "app/validate/case_result.h"

namespace sprung {

/// A number as people read it, with a real minus sign; a dash where there is none.
[[nodiscard]] std::string html_number(double value);

/// The checks of one experiment as HTML. Where they vary grids or ratios, first their errors in a matrix of short rows;
/// all measurements follow, folded where there are many, with their sources.
[[nodiscard]] std::string html_checks(const std::vector<const Check*>& checks);

/// A table of words and numbers as HTML; empty where it has no rows.
[[nodiscard]] std::string html_table(const TextTable& table);

}  // namespace sprung
