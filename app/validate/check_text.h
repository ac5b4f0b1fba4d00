#pragma once
#include <string>
#include <vector>

#include "app/validate/check.h"

namespace sprung {

/// "+1.23 %", or the plain difference where 0 is expected; empty where there is none.
[[nodiscard]] std::string error_text(const Check& check);

/// One line for people: experiment, quantity, model, ratio, grid, measured, expected, error, tolerance, result, source.
[[nodiscard]] std::string check_line(const Check& check);

/// All checks as one JSON array.
[[nodiscard]] std::string checks_json(const std::vector<Check>& checks);

}  // namespace sprung
