#pragma once
#include <array>
#include <functional>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The surface of a cube [0, 1]^3 under a map that keeps its orientation, as triangles of `divisions` along its edges.
/// Its faces are parts: "x-low", "x-high", ... "z-high".
[[nodiscard]] SurfaceMesh mapped_block(const std::array<int, 3>& divisions,
                                       const std::function<Vec3(const Vec3& position)>& map);

/// A block of these sides with its low corner at the origin.
[[nodiscard]] SurfaceMesh block_mesh(const Vec3& sides);

}  // namespace sprung
