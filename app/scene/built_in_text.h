#pragma once
#include <string_view>

namespace sprung {

/// assets/materials.toml, which the build puts into the program.
[[nodiscard]] std::string_view built_in_materials_text();

}  // namespace sprung
