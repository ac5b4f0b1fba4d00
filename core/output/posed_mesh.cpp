#include "core/output/posed_mesh.h"

#include <Eigen/Geometry>

namespace sprung {

std::vector<PosedPart> parts_of(const PosedMesh& mesh) {
  std::vector<Part> parts = mesh.rest->parts;
  if (parts.empty()) {
    parts.push_back(
        {.name = mesh.name, .first_triangle = 0, .triangle_count = static_cast<int>(mesh.rest->triangles.rows())});
  }
  std::vector<PosedPart> all;
  for (const Part& part : parts) {
    PosedPart posed{.name = part.name.empty() ? mesh.name : part.name,
                    .first_triangle = part.first_triangle,
                    .triangle_count = part.triangle_count,
                    .material = mesh.name + " skin"};
    posed.color << mesh.color, 1;
    if (mesh.rest->colors.rows() > 0) posed.color.setOnes();  // which programs multiply by those
    if (part.material >= 0) {
      posed.source = &mesh.rest->materials[static_cast<std::size_t>(part.material)];
      posed.color = posed.source->color;
      posed.material = posed.source->name.empty() ? mesh.name + " " + std::to_string(part.material + 1)
                                                  : mesh.name + " " + posed.source->name;
    }
    all.push_back(std::move(posed));
  }
  return all;
}

std::string ending_of_texture(const SurfaceMaterial& material) {
  const std::vector<std::byte>& bytes = material.texture;
  if (bytes.size() < 4) return "";
  if (bytes[0] == std::byte{0x89} && bytes[1] == std::byte{'P'}) return ".png";
  if (bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8}) return ".jpg";
  return "";
}

Points shading_normals(const PosedMesh& mesh) {
  if (mesh.normals.rows() > 0) return mesh.normals;
  const Points& positions = mesh.positions;
  Points sums = Points::Zero(positions.rows(), 3);
  for (const auto& t : mesh.rest->triangles.rowwise()) {
    const Eigen::RowVector3d a = positions.row(t[0]);
    const Eigen::RowVector3d normal = (positions.row(t[1]) - a).cross(positions.row(t[2]) - a);
    for (const int corner : t) sums.row(corner) += normal;
  }
  for (auto sum : sums.rowwise()) {
    if (sum.norm() > 0) {
      sum.normalize();
    } else {
      sum = Eigen::RowVector3d::UnitY();
    }
  }
  return sums;
}

}  // namespace sprung
