#pragma once
#include <string>
#include <vector>

#include "app/validate/case_result.h"

namespace sprung {

/// "+1.23 %", or the plain difference where 0 is expected; empty where there is none.
[[nodiscard]] std::string error_text(const Check& check);

/// One line for people: experiment, quantity, model, ratio, grid, measured, expected, error, tolerance, result, source.
/// The result of what could not be measured is "none", and the source says why.
[[nodiscard]] std::string check_line(const Check& check);

/// The source of the expectation, and why nothing was measured where that is so.
[[nodiscard]] std::string source_text(const Check& check);

/// A table in columns of equal width, a line a row; empty where it has no rows.
[[nodiscard]] std::string table_text(const TextTable& table);

/// All checks as one JSON array.
[[nodiscard]] std::string checks_json(const std::vector<Check>& checks);

}  // namespace sprung
