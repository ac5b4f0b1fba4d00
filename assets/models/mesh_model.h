#pragma once
#include "assets/models/model.h"
#include "assets/models/toy.h"

namespace sprung::models {

/// The surface of the model in triangles, by CGAL's Delaunay mesher (Mesh_3), relaxed along the surface and projected
/// onto it; normals from the shape's gradient. Deterministic.
[[nodiscard]] Toy mesh_model(const Model& model);

/// A plain box with its bottom centre at the origin, in squares of side `cell`, m, cut in two triangles each. No
/// normals: its edges are sharp.
[[nodiscard]] Toy make_box(const Vec3& size, double cell, const Color& color);

}  // namespace sprung::models
