#include "core/mesh/repair/submesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/unit_rows.h"

namespace sprung {
namespace {

template <class Rows>
void take_rows(Rows& rows, const std::vector<int>& wanted) {
  if (rows.rows() > 0) rows = Rows(rows(wanted, Eigen::all));
}

/// The parts of the chosen triangles, which are in ascending order.
std::vector<Part> parts_of(const std::vector<Part>& parts, const std::vector<int>& triangles) {
  std::vector<Part> chosen;
  for (const Part& part : parts) {
    const auto first = std::lower_bound(triangles.begin(), triangles.end(), part.first_triangle);
    const auto last = std::lower_bound(first, triangles.end(), part.first_triangle + part.triangle_count);
    if (first == last) continue;
    chosen.push_back(part);
    chosen.back().first_triangle = int(first - triangles.begin());
    chosen.back().triangle_count = int(last - first);
  }
  return chosen;
}

/// For each point of the solid a vertex of the mesh, or -1 if only caps use it.
std::vector<int> vertices_of_points(const SurfaceMesh& mesh, const Solid& solid) {
  std::vector<int> vertices(solid.points.rows(), -1);
  for (int t = 0; t < solid.triangles.rows(); ++t) {
    const int row = solid.source[t];
    if (row < 0) continue;
    for (int k = 0; k < 3; ++k) {
      const int corner = solid.flipped[t] ? (3 - k) % 3 : k;
      vertices[solid.triangles(t, k)] = mesh.triangles(row, corner);
    }
  }
  return vertices;
}

/// The triangles of caps, with points of their own.
struct Caps {
  std::vector<int> points;     // of the solid
  Triangles triangles;         // rows of `points`
  std::vector<int> lookalike;  // for each point, the vertex of the mesh with its UV and colour
};

/// The vertex of the rim nearest to a point, for the inner points of a cap.
int nearest_vertex(const Solid& solid, const Caps& caps, const std::vector<int>& vertices, int point) {
  double least = std::numeric_limits<double>::infinity();
  int nearest = 0;
  for (const int other : caps.points) {
    const double distance = (solid.points.row(other) - solid.points.row(point)).squaredNorm();
    if (vertices[other] < 0 || distance >= least) continue;
    least = distance;
    nearest = vertices[other];
  }
  return nearest;
}

Caps find_caps(const SurfaceMesh& mesh, const Solid& solid) {
  Caps caps;
  const auto count = int(std::count(solid.source.begin(), solid.source.end(), -1));
  caps.triangles.resize(count, 3);
  std::vector<int> row_of(solid.points.rows(), -1);
  int next = 0;
  for (int t = 0; t < solid.triangles.rows(); ++t) {
    if (solid.source[t] >= 0) continue;
    for (int k = 0; k < 3; ++k) {
      int& row = row_of[solid.triangles(t, k)];
      if (row < 0) {
        row = isize(caps.points);
        caps.points.push_back(solid.triangles(t, k));
      }
      caps.triangles(next, k) = row;
    }
    ++next;
  }
  if (mesh.uvs.rows() + mesh.colors.rows() + mesh.normals.rows() == 0) return caps;
  const std::vector<int> vertices = vertices_of_points(mesh, solid);
  for (const int point : caps.points) {
    const int vertex = vertices[point];
    caps.lookalike.push_back(vertex >= 0 ? vertex : nearest_vertex(solid, caps, vertices, point));
  }
  return caps;
}

/// The area-weighted mean normal of the cap at each point.
Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals_of(const Points& points, const Triangles& triangles) {
  Points sums = Points::Zero(points.rows(), 3);
  for (const auto& t : triangles.rowwise()) {
    const Eigen::RowVector3d a = points.row(t[0]);
    const Eigen::RowVector3d normal = (points.row(t[1]) - a).cross(points.row(t[2]) - a);
    for (const int corner : t) sums.row(corner) += normal;
  }
  return unit_rows(sums).cast<float>();
}

template <class Rows, class More>
void append_rows(Rows& rows, const More& more) {
  Rows joined(rows.rows() + more.rows(), rows.cols());
  joined << rows, more;
  rows = std::move(joined);
}

void add_caps(const SurfaceMesh& mesh, const Solid& solid, SurfaceMesh& part) {
  const Caps caps = find_caps(mesh, solid);
  if (caps.triangles.rows() == 0) return;
  const auto first_vertex = int(part.positions.rows());
  const auto first_triangle = int(part.triangles.rows());
  const Points points = solid.points(caps.points, Eigen::all);
  append_rows(part.positions, points);
  append_rows(part.triangles, (caps.triangles.array() + first_vertex).matrix());
  if (mesh.normals.rows() > 0) append_rows(part.normals, normals_of(points, caps.triangles));
  if (mesh.uvs.rows() > 0) append_rows(part.uvs, mesh.uvs(caps.lookalike, Eigen::all));
  if (mesh.colors.rows() > 0) append_rows(part.colors, mesh.colors(caps.lookalike, Eigen::all));
  part.parts.push_back({.name = "cap",
                        .first_triangle = first_triangle,
                        .triangle_count = int(caps.triangles.rows()),
                        .material = part.parts.empty() ? -1 : part.parts.front().material});
}

}  // namespace

SurfaceMesh submesh(const SurfaceMesh& mesh, const Solid& solid) {
  std::vector<int> order;
  for (std::size_t t = 0; t < solid.source.size(); ++t) {
    if (solid.source[t] >= 0) order.push_back(int(t));
  }
  const auto source = [&](int t) { return solid.source[t]; };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return source(a) < source(b); });
  std::vector<int> rows;
  rows.reserve(order.size());
  for (const int t : order) rows.push_back(source(t));
  SurfaceMesh part;
  part.triangles = mesh.triangles(rows, Eigen::all);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Eigen::Index row = i;
    if (solid.flipped[order[i]]) std::swap(part.triangles(row, 1), part.triangles(row, 2));
  }
  std::vector<int> new_vertex(mesh.positions.rows(), -1);
  std::vector<int> vertices;
  for (int& vertex : part.triangles.reshaped<Eigen::RowMajor>()) {
    int& number = new_vertex[vertex];
    if (number < 0) {
      number = isize(vertices);
      vertices.push_back(vertex);
    }
    vertex = number;
  }
  part.positions = mesh.positions(vertices, Eigen::all);
  part.normals = mesh.normals;
  part.uvs = mesh.uvs;
  part.colors = mesh.colors;
  take_rows(part.normals, vertices);
  take_rows(part.uvs, vertices);
  take_rows(part.colors, vertices);
  part.parts = parts_of(mesh.parts, rows);
  part.materials = mesh.materials;
  add_caps(mesh, solid, part);
  return part;
}

}  // namespace sprung
