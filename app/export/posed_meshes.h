#pragma once
#include <vector>

#include "app/build_world.h"
#include "core/io/mesh_export.h"

namespace sprung {

/// The meshes of all bodies and their copies for these positions of the nodes (by actor, m): vertices, order and
/// triangles are those of the files. They point into the production.
[[nodiscard]] std::vector<PosedMesh> posed_meshes(const Production& production, const Scene& scene,
                                                  const std::vector<Points>& nodes);

}  // namespace sprung
