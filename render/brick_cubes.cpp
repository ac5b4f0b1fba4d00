#include "render/brick_cubes.h"

#include <algorithm>
#include <utility>

namespace sprung {
namespace {

constexpr double kRim = 0.055;      // of a face, at each side
constexpr float kRimShade = 0.55F;  // of a face's colour
constexpr double kGap = 0.16;       // of a brick, at each side, if they are exploded
constexpr int kCells = 3;           // of a face along each side: rim, face, rim
constexpr int kFaceVertices = 4 * kCells * kCells;

template <class Values>
auto interpolate_corners(const Values& corners, double u, double v) {
  return (1 - u) * (1 - v) * corners[0] + u * (1 - v) * corners[1] + u * v * corners[2] + (1 - u) * v * corners[3];
}

/// (u, v) of a cell's corner in its face, 0 to 1; corners counter-clockwise.
std::pair<double, double> place_in_face(int cell, int corner) {
  constexpr std::array<double, kCells + 1> borders{0, kRim, 1 - kRim, 1};
  const std::size_t u = cell % kCells + (corner == 1 || corner == 2 ? 1 : 0);
  const std::size_t v = cell / kCells + (corner >= 2 ? 1 : 0);
  return {borders[u], borders[v]};
}

}  // namespace

BrickCubes::BrickCubes(const BrickGrid& grid, const std::vector<bool>& shown, bool exploded,
                       const std::vector<Eigen::Vector3f>& colors)
    : grid_(grid), exploded_(exploded), faces_(exploded ? brick_faces(grid, shown) : outer_faces(grid, shown)) {
  const Eigen::Index count = faces_.size();
  skin_.colors.resize(kFaceVertices * count, 4);
  skin_.triangles.resize(2 * kCells * kCells * count, 3);
  for (Eigen::Index face = 0; face < count; ++face) {
    const Eigen::Vector3f& color = colors[faces_[face].brick];
    for (int cell = 0; cell < kCells * kCells; ++cell) {
      const auto first = int(kFaceVertices * face) + 4 * cell;
      const auto triangle = 2 * (kCells * kCells * face + cell);
      skin_.triangles.row(triangle) << first, first + 1, first + 2;
      skin_.triangles.row(triangle + 1) << first, first + 2, first + 3;
      const bool is_rim = cell != kCells * kCells / 2;
      for (int corner = 0; corner < 4; ++corner) {
        skin_.colors.row(first + corner) << (is_rim ? kRimShade : 1.0F) * color.transpose(), 1.0F;
      }
    }
  }
}

std::array<Vec3, 4> BrickCubes::corners(const BrickFace& face, const Points& nodes) const {
  std::array<Vec3, 4> places;
  for (std::size_t c = 0; c < 4; ++c) places[c] = nodes.row(face.nodes[c]);
  if (!exploded_) return places;
  Vec3 middle = Vec3::Zero();
  for (const int node : grid_.nodes[face.brick]) middle += nodes.row(node).transpose() / 8;
  for (Vec3& position : places) position += 2 * kGap * (middle - position);
  return places;
}

SkinShape BrickCubes::shape(const Points& nodes, const Eigen::VectorXd& coordinates) const {
  const Eigen::Index count = faces_.size();
  SkinShape shape;
  shape.positions.resize(kFaceVertices * count, 3);
  shape.normals.resize(kFaceVertices * count, 3);
  if (coordinates.size() > 0) shape.map_coordinates.resize(kFaceVertices * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const BrickFace& face = faces_[i];
    const std::array<Vec3, 4> places = corners(face, nodes);
    const Vec3 normal = (places[2] - places[0]).cross(places[3] - places[1]);
    for (int vertex = 0; vertex < kFaceVertices; ++vertex) {
      const auto [u, v] = place_in_face(vertex / 4, vertex % 4);
      const Eigen::Index row = kFaceVertices * i + vertex;
      shape.positions.row(row) = interpolate_corners(places, u, v).cast<float>().transpose();
      shape.normals.row(row) = normal.cast<float>().transpose();
      if (coordinates.size() == 0) continue;
      std::array<double, 4> of_corners{};
      for (std::size_t c = 0; c < 4; ++c) of_corners[c] = coordinates[face.nodes[c]];
      const bool is_rim = vertex / 4 != kCells * kCells / 2;
      shape.map_coordinates[row] =
          float(std::clamp(interpolate_corners(of_corners, u, v), 0.0, 1.0) + (is_rim ? 2 : 0));
    }
  }
  return shape;
}

Skin with_shape(Skin skin, const SkinShape& shape) {
  skin.positions = shape.positions.cast<double>();
  skin.normals = shape.normals.cast<double>();
  return skin;
}

}  // namespace sprung
