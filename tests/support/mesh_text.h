#pragma once
#include <fmt/format.h>

#include <string>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// The mesh as an OFF file.
inline std::string off_text(const SurfaceMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.positions.rows(), mesh.triangles.rows());
  for (const auto& p : mesh.positions.rowwise()) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles.rowwise()) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace sprung
