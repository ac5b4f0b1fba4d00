#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// A mesh as bytes, for another process of the same build.
[[nodiscard]] std::vector<std::byte> bytes_from_mesh(const SurfaceMesh& mesh);

/// The mesh in such bytes. Throws Error(kFailed) where they are anything else, before allocating more than they hold.
[[nodiscard]] SurfaceMesh mesh_from_bytes(std::span<const std::byte> bytes);

/// Empty where a mesh is flat and whole: finite coordinates, corners in range, as many normals, UVs and colours as
/// positions or none, parts that cover all triangles in order and name materials that are there; else what is wrong.
[[nodiscard]] std::string find_fault(const SurfaceMesh& mesh);

}  // namespace sprung
