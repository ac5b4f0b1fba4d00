#pragma once
#include <string>
#include <string_view>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The mesh in the text of an OFF file, with what COFF, NOFF and STOFF add to the vertices. `name` is that of the file,
/// for messages. Throws Error(kBadInput) with the line, before anything is allocated that the text could not hold.
[[nodiscard]] SurfaceMesh read_off(std::string_view text, const std::string& name);

}  // namespace sprung
