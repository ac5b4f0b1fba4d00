#pragma once
#include <string>
#include <vector>

#include "app/console.h"
#include "app/scene.h"
#include "core/mesh/solids.h"

namespace sprung {

/// A body of the scene in its rest frame: metres, the middle of its bounding box at the origin, not yet turned.
struct LoadedBody {
  std::string name;  // of the file, for messages
  SurfaceMesh mesh;
  std::vector<Solid> solids;
  Vec3 extent = Vec3::Zero();  // m, sides of the bounding box
  double brick_size = 0;       // m
};

/// Reads the mesh, brings it to its size and finds its solids; says what it had to choose or to mend.
/// Throws Error(kBadInput).
[[nodiscard]] LoadedBody load_body(const SceneBody& body, const Console& console);

/// The triangles of a mesh that bound a solid, turned outward as the solid has them, and the vertices, parts and
/// materials that they need.
[[nodiscard]] SurfaceMesh submesh(const SurfaceMesh& mesh, const Solid& solid);

}  // namespace sprung
