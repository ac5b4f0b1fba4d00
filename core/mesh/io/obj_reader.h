#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The materials of an MTL text (material library of OBJ): name, diffuse colour and the name of its texture. Lines that
/// cannot be read are passed over: they cannot spoil the shape.
[[nodiscard]] std::vector<SurfaceMaterial> read_mtl(std::string_view text);

}  // namespace sprung
