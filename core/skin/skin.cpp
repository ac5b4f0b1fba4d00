#include "core/skin/skin.h"

#include "core/skin/corner_normals.h"
#include "core/skin/refine.h"

namespace sprung {
namespace {

template <class Rows>
Rows rows_of(const Rows& all, const std::vector<int>& rows) {
  if (all.rows() == 0) return {};
  return all(rows, Eigen::all);
}

}  // namespace

Skin make_skin(const SurfaceMesh& mesh, const SkinOptions& options) {
  const SplitVertices split = split_at_creases(mesh, options.crease_angle);
  Skin skin;
  skin.positions = rows_of(mesh.positions, split.source);
  skin.normals = split.normals;
  skin.uvs = rows_of(mesh.uvs, split.source);
  skin.colors = rows_of(mesh.colors, split.source);
  skin.triangles = split.triangles;
  skin.parts = mesh.parts;
  skin.materials = mesh.materials;
  if (options.max_edge > 0) refine(skin, options.max_edge);
  return skin;
}

}  // namespace sprung
