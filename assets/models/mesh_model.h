#pragma once
#include <array>

#include "assets/models/model.h"
#include "assets/models/toy.h"

namespace sprung::models {

/// The surface of the model in triangles, by CGAL's Delaunay mesher (Mesh_3), relaxed along the surface and projected
/// onto it; normals from the shape's gradient. Deterministic.
[[nodiscard]] Toy mesh_model(const Model& model);

/// A plain box with its bottom centre at the origin, cut in rectangles of two triangles each by planes across its three
/// axes; cm, ascending, the outermost its faces. No normals: its edges are sharp.
[[nodiscard]] Toy make_box(const std::array<std::vector<double>, 3>& planes,
                           const std::function<Color(const Vec3&)>& paint);

/// A bar to measure, a banded plank, a flag and a wall of blocks; bars with rounded edges: of taffy, in bands, and a
/// stick of candy, whose edges are stripes.
[[nodiscard]] Toy make_beam();
[[nodiscard]] Toy make_plank();
[[nodiscard]] Toy make_taffy();
[[nodiscard]] Toy make_stick();
[[nodiscard]] Toy make_flag();
[[nodiscard]] Toy make_wall();

}  // namespace sprung::models
