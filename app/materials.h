#pragma once
#include <string>

namespace sprung {

/// The library of materials as a table for people.
[[nodiscard]] std::string materials_table();

}  // namespace sprung
