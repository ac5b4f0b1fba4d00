#include "core/mesh/read_mesh.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/mesh/assimp_reader.h"
#include "core/mesh/file_checks.h"
#include "core/mesh/off_reader.h"

namespace sprung {
namespace {

/// What no reader promises: faces at all, indices in range and finite coordinates.
void check_content(const SurfaceMesh& mesh, const std::string& name) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name, reason));
  };
  const int vertices = static_cast<int>(mesh.positions.rows());
  for (int v = 0; v < vertices; ++v) {
    if (!mesh.positions.row(v).allFinite()) refuse(fmt::format("vertex {} has a coordinate that is not finite", v + 1));
  }
  if (mesh.triangles.rows() == 0) {
    refuse(vertices > 0 ? fmt::format("no faces (a point cloud of {} points)", vertices) : "no faces");
  }
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= vertices) refuse("a face index is out of range");
}

}  // namespace

SurfaceMesh read_mesh(const std::filesystem::path& file) {
  check_mesh_file(file);
  SurfaceMesh mesh = lower_extension(file) == ".off" ? read_off(file) : read_by_assimp(file);
  check_content(mesh, file.string());
  return mesh;
}

}  // namespace sprung
