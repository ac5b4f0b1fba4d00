#include "render/body_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/body/brick_kernel.h"
#include "render/image/color_map.h"
#include "render/renderer.h"

namespace sprung {
namespace {

constexpr double kLine = 0.0022;     // half the width of the lines between bricks over the diagonal of the body
constexpr double kLineShade = 0.64;  // of a face's colour
constexpr double kWidestRim = 0.08;  // of a face
constexpr int kFinestSplit = 8;      // cells along a side of a face without its rim
constexpr int kWantedSplit = 48;     // the same over all faces along the body

/// Sums of the normals of the faces around each node, separately for the six orientations of faces: 6 m x 3.
Points node_normals(const std::vector<BrickFace>& faces, const Points& positions) {
  Points normals = Points::Zero(6 * positions.rows(), 3);
  for (const BrickFace& face : faces) {
    const Vec3 across = positions.row(face.nodes[2]) - positions.row(face.nodes[0]);
    const Vec3 other = positions.row(face.nodes[3]) - positions.row(face.nodes[1]);
    for (const int node : face.nodes) normals.row(6 * node + face.side) += across.cross(other);
  }
  return normals;
}

/// `rim` and `faces_along` the body in units of a face's side.
Skin face_skin(const std::vector<BrickFace>& faces, const Points& positions, const CornerColor& color, double rim,
               int faces_along) {
  rim = std::min(rim, kWidestRim);
  const int split = std::clamp(kWantedSplit / std::max(1, faces_along), 1, kFinestSplit);
  std::vector<double> borders{0};  // of the cells of a face; the first and the last are the rim
  for (int i = 0; i <= split; ++i) borders.push_back(rim + (1 - 2 * rim) * i / split);
  borders.push_back(1);
  const int cells = split + 2;
  const Eigen::Index vertices = 4L * cells * cells * isize(faces);
  Skin skin;
  skin.positions.resize(vertices, 3);
  skin.normals.resize(vertices, 3);
  skin.colors.setOnes(vertices, 4);
  skin.triangles.resize(vertices / 2, 3);
  const Points normals = node_normals(faces, positions);
  int vertex = 0;
  for (const BrickFace& face : faces) {
    Eigen::Matrix<double, 4, 3> corners;
    Eigen::Matrix<double, 4, 3> directions;
    Eigen::Matrix<double, 4, 3> colors;
    for (int c = 0; c < 4; ++c) {
      corners.row(c) = positions.row(face.nodes[c]);
      directions.row(c) = normals.row(6 * face.nodes[c] + face.side).normalized();
      colors.row(c) = color(face, c).cast<double>();
    }
    for (int cell = 0; cell < cells * cells; ++cell) {
      const int i = cell / cells;
      const int j = cell % cells;
      const bool is_rim = i == 0 || j == 0 || i + 1 == cells || j + 1 == cells;
      for (int c = 0; c < 4; ++c, ++vertex) {
        const double u = borders[i + (c == 1 || c == 2 ? 1 : 0)];
        const double v = borders[j + (c >= 2 ? 1 : 0)];
        const Eigen::RowVector4d weights((1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v);
        const auto mix = [&](const Eigen::Matrix<double, 4, 3>& at) -> Eigen::RowVector3d {
          return weights[0] * at.row(0) + weights[1] * at.row(1) + weights[2] * at.row(2) + weights[3] * at.row(3);
        };
        skin.positions.row(vertex) = mix(corners);
        skin.normals.row(vertex) = mix(directions).normalized();
        skin.colors.row(vertex).head<3>() = ((is_rim ? kLineShade : 1) * mix(colors)).cast<float>();
      }
      skin.triangles.row(vertex / 2 - 2) << vertex - 4, vertex - 3, vertex - 2;
      skin.triangles.row(vertex / 2 - 1) << vertex - 4, vertex - 2, vertex - 1;
    }
  }
  return skin;
}

/// The colours of nodes by `values` (m, from 0).
CornerColor color_map(const Eigen::VectorXd& values) {
  return [&values, highest = std::max(values.maxCoeff(), 1e-300)](const BrickFace& face, int corner) {
    return map_color(ColorMap::kViridis, values[face.nodes[corner]] / highest);
  };
}

/// Norm of Green's strain of each brick's mean axes, averaged at the nodes.
Eigen::VectorXd node_strains(const Body& body) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(body.node_count());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(body.node_count());
  for (std::size_t brick = 0; brick < body.grid.cells.size(); ++brick) {
    const auto axes = detail::mean_axes(brick_corners(body, brick));
    Mat3 gradient;
    for (int i = 0; i < 3; ++i) {
      for (int c = 0; c < 3; ++c) gradient(c, i) = axes[i][c] / body.grid.brick_size;
    }
    const double strain = (0.5 * (gradient.transpose() * gradient - Mat3::Identity())).norm();
    for (const int node : body.grid.nodes[brick]) {
      sums[node] += strain;
      counts[node] += 1;
    }
  }
  return sums.cwiseQuotient(counts);
}

Image draw_on_white(const Skin& skin, const BodyPictureOptions& options, double azimuth, double elevation) {
  Stage stage;
  stage.skins = {&skin};
  stage.default_colors = {Eigen::Vector3f::Ones()};
  stage.bounds = bounding_box(skin.positions);
  stage.has_ground = false;
  const double aspect = double(options.width) / options.height;
  Renderer renderer(stage, {.width = options.width, .height = options.height, .transparent = true});
  Image image = renderer.draw({{skin.positions.cast<float>(), skin.normals.cast<float>()}},
                              frame_points(skin.positions, aspect, azimuth, elevation));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const int alpha = image.alpha[i / 3];
    image.pixels[i] = std::uint8_t((image.pixels[i] * alpha + 255 * (255 - alpha) + 127) / 255);
  }
  image.alpha.clear();
  return image;
}

}  // namespace

Skin brick_skin(const Body& body, const Points& positions, const CornerColor& color, double line) {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();
  for (const Eigen::Vector3i& node : body.grid.lattice) size = size.cwiseMax(node);
  return face_skin(outer_faces(body.grid), positions, color, line / body.grid.brick_size, size.maxCoeff());
}

BodyPicture draw_body(const Body& body, const BodyPictureOptions& options) {
  const bool is_strain = options.color_by == ColorBy::kStrain;
  const Points moved = body.positions - body.rest_positions;
  const Points shown = body.rest_positions + options.magnification * moved;
  const Eigen::VectorXd values = is_strain ? Eigen::VectorXd(100 * node_strains(body)) : 1000 * moved.rowwise().norm();
  const Skin skin = brick_skin(body, shown, color_map(values), kLine * bounding_box(shown).diagonal().norm());
  return {draw_on_white(skin, options, 30, 18), is_strain ? "strain (%)" : "displacement (mm)", 0, values.maxCoeff()};
}

BodyPicture draw_membrane(const Membrane& membrane, const BodyPictureOptions& options) {
  constexpr int kTowardsViewer = 5;  // +z
  const Points2 moved = membrane.positions - membrane.rest_positions;
  const Eigen::VectorXd values = 1000 * moved.rowwise().norm();
  Points shown = Points::Zero(membrane.node_count(), 3);
  shown.leftCols<2>() = membrane.rest_positions + options.magnification * moved;
  std::vector<BrickFace> faces;
  for (const auto& nodes : membrane.rectangles) {
    faces.push_back({.nodes = {nodes[0], nodes[1], nodes[3], nodes[2]}, .side = kTowardsViewer, .brick = 0});
  }
  const double side = membrane.law.sides[0];
  const int along = int(std::lround(membrane.rest_positions.maxCoeff() / side));
  const Skin skin =
      face_skin(faces, shown, color_map(values), kLine * bounding_box(shown).diagonal().norm() / side, along);
  return {draw_on_white(skin, options, 0, 0), "displacement (mm)", 0, values.maxCoeff()};
}

}  // namespace sprung
