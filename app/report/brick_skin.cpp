#include "app/report/brick_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "core/bricks/brick_grid.h"

namespace sprung {

namespace {

constexpr double kRimShade = 0.64;   // of a face's colour
constexpr double kWidestRim = 0.08;  // of a face
constexpr int kFinestSplit = 8;      // cells of a face along a side, rim left out
constexpr int kWantedSplit = 48;     // the same over all bricks along a body

/// The colours of a face's corners.
using CornerColors = std::function<Eigen::Vector3f(const BrickFace& face, std::size_t corner)>;

CornerColors by_node(const std::vector<Eigen::Vector3f>& colors) {
  return [&](const BrickFace& face, std::size_t corner) { return colors[face.nodes[corner]]; };
}

/// Sums of the normals of the faces at each node, one sum for each side that faces can look to: 6 m x 3.
Points node_normals(const std::vector<BrickFace>& faces, const Points& positions) {
  Points normals = Points::Zero(6 * positions.rows(), 3);
  for (const BrickFace& face : faces) {
    const Vec3 across = positions.row(face.nodes[2]) - positions.row(face.nodes[0]);
    const Vec3 other = positions.row(face.nodes[3]) - positions.row(face.nodes[1]);
    for (const int node : face.nodes) normals.row(6 * node + face.side) += across.cross(other);
  }
  return normals;
}

/// Where the cells of a face begin and end, from 0 to 1; the first and last are the rim.
std::vector<double> cell_borders(int split, double rim) {
  std::vector<double> borders{0};
  for (int i = 0; i <= split; ++i) borders.push_back(rim + (1 - 2 * rim) * i / split);
  borders.push_back(1);
  return borders;
}

/// What a face's corners carry, mixed at (u, v) in it.
template <class Values>
auto mixed(const Values& corner, double u, double v) {
  return ((1 - u) * (1 - v) * corner(0) + u * (1 - v) * corner(1) + u * v * corner(2) + (1 - u) * v * corner(3)).eval();
}

/// Appends faces to a skin that is large enough for all of them.
class FaceWriter {
 public:
  FaceWriter(Skin& skin, std::vector<double> borders) : skin_(skin), borders_(std::move(borders)) {}

  [[nodiscard]] Eigen::Index cells_per_face() const {
    const Eigen::Index cells = borders_.size() - 1;
    return cells * cells;
  }

  void add(const BrickFace& face, const Points& positions, const Points& normals, const CornerColors& colors) {
    const auto place = [&](std::size_t c) { return Vec3(positions.row(face.nodes[c])); };
    const auto normal = [&](std::size_t c) { return Vec3(normals.row(6 * face.nodes[c] + face.side)).normalized(); };
    const auto color = [&](std::size_t c) { return Vec3(colors(face, c).cast<double>()); };
    const std::size_t cells = borders_.size() - 1;
    for (std::size_t i = 0; i < cells; ++i) {
      for (std::size_t j = 0; j < cells; ++j) {
        const bool rim = i == 0 || j == 0 || i + 1 == cells || j + 1 == cells;
        for (const auto& [di, dj] : {std::pair{0U, 0U}, {1U, 0U}, {1U, 1U}, {0U, 1U}}) {
          const double u = borders_[i + di];
          const double v = borders_[j + dj];
          skin_.positions.row(vertex_) = mixed(place, u, v);
          skin_.normals.row(vertex_) = mixed(normal, u, v).normalized();
          const Vec3 tint = (rim ? kRimShade : 1.0) * mixed(color, u, v);
          for (int c = 0; c < 3; ++c) skin_.colors(vertex_, c) = float(tint[c]);
          skin_.colors(vertex_++, 3) = 1;
        }
        const auto first = int(vertex_ - 4);
        skin_.triangles.row(triangle_++) << first, first + 1, first + 2;
        skin_.triangles.row(triangle_++) << first, first + 2, first + 3;
      }
    }
  }

 private:
  Skin& skin_;
  std::vector<double> borders_;
  Eigen::Index vertex_ = 0;
  Eigen::Index triangle_ = 0;
};

/// Faces as a skin; `split` cells along each, a rim of that share of a face.
Skin skin_of(const std::vector<BrickFace>& faces, const Points& positions, const CornerColors& colors, int split,
             double rim) {
  Skin skin;
  FaceWriter writer(skin, cell_borders(split, std::min(rim, kWidestRim)));
  const Eigen::Index cells = writer.cells_per_face() * Eigen::Index(faces.size());
  skin.positions.resize(4 * cells, 3);
  skin.normals.resize(4 * cells, 3);
  skin.colors.resize(4 * cells, 4);
  skin.triangles.resize(2 * cells, 3);
  const Points normals = node_normals(faces, positions);
  for (const BrickFace& face : faces) writer.add(face, positions, normals, colors);
  return skin;
}

int split_for(int faces_along) { return std::clamp(kWantedSplit / std::max(1, faces_along), 1, kFinestSplit); }

}  // namespace

namespace {

Skin brick_skin(const Body& body, const Points& positions, const CornerColors& colors, double line) {
  const Eigen::Vector3i size = Eigen::Map<const Eigen::Matrix<int, 3, Eigen::Dynamic>>(body.grid.lattice.front().data(),
                                                                                       3, body.grid.node_count())
                                   .rowwise()
                                   .maxCoeff();
  return skin_of(outer_faces(body.grid), positions, colors, split_for(size.maxCoeff()), line / body.grid.brick_size);
}

}  // namespace

Skin brick_skin(const Body& body, const Points& positions, const std::vector<Eigen::Vector3f>& colors, double line) {
  return brick_skin(body, positions, by_node(colors), line);
}

Skin colored_bricks(const Body& body, const Points& positions, const std::vector<Eigen::Vector3f>& colors,
                    double line) {
  const CornerColors by_brick = [&](const BrickFace& face, std::size_t) { return colors[face.brick]; };
  return brick_skin(body, positions, by_brick, line);
}

Skin membrane_skin(const Membrane& membrane, const Points& positions, const std::vector<Eigen::Vector3f>& colors,
                   double line) {
  constexpr int kTowardsViewer = 5;  // +z
  std::vector<BrickFace> faces;
  for (const auto& nodes : membrane.rectangles) {
    faces.push_back({.nodes = {nodes[0], nodes[1], nodes[3], nodes[2]}, .side = kTowardsViewer, .brick = 0});
  }
  const double longest =
      (membrane.rest_positions.colwise().maxCoeff() - membrane.rest_positions.colwise().minCoeff()).maxCoeff();
  const int faces_along = int(std::lround(longest / membrane.law.sides[0]));
  return skin_of(faces, positions, by_node(colors), split_for(faces_along), line / membrane.law.sides[0]);
}

}  // namespace sprung
