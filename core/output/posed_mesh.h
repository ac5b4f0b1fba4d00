#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// A mesh as it stands in one frame, in the world. What does not change is that of the mesh at rest.
struct PosedMesh {
  std::string name;
  const Skin* rest = nullptr;
  Eigen::Vector3f color{0.8F, 0.8F, 0.8F};  // sRGB, of what has no colours of its own
  Points positions;                         // n x 3, m
  Points normals;                           // n x 3, unit; 0 rows: the mesh has none
};

/// A part of a mesh that looks alike, with what is known of it; a mesh without parts is one.
struct PosedPart {
  std::string name;
  int first_triangle = 0;
  int triangle_count = 0;
  std::string material;                        // a name of its own among those of all meshes
  Eigen::Vector4f color{0.8F, 0.8F, 0.8F, 1};  // sRGB and opacity
  const SurfaceMaterial* source = nullptr;     // with a texture perhaps; null: none
};
[[nodiscard]] std::vector<PosedPart> parts_of(const PosedMesh& mesh);

/// ".png" or ".jpg" by the first bytes of an encoded picture; "" where it is neither.
[[nodiscard]] std::string ending_of_texture(const SurfaceMaterial& material);

/// The mesh's own normals; where it has none, sums of the triangles' normals at each vertex, by area, as unit vectors.
[[nodiscard]] Points shading_normals(const PosedMesh& mesh);

}  // namespace sprung
