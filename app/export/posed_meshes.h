#pragma once
#include <vector>

#include "app/scene/film.h"
#include "core/io/mesh_export.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// The meshes of all bodies and their copies for these positions of the nodes (by body, m), with the vertices, order
/// and triangles of the files. They point into the simulation.
[[nodiscard]] std::vector<PosedMesh> posed_meshes(const Simulation& simulation, const Film& film,
                                                  const std::vector<Points>& nodes);

/// For each body of the world, the index in posed_meshes() of the mesh that it deforms, whole or in part.
[[nodiscard]] std::vector<std::size_t> meshes_of_bodies(const Simulation& simulation);

/// How many meshes a film has.
[[nodiscard]] std::size_t mesh_count(const Film& film);

}  // namespace sprung
