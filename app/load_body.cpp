#include "app/load_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <span>

#include "app/box_shape.h"
#include "core/error.h"
#include "core/mesh/read_mesh.h"

namespace sprung {
namespace {

/// In double and before anything else, so that a mesh far from its origin loses nothing later.
Vec3 recentre(SurfaceMesh& mesh) {
  const Vec3 low = mesh.positions.colwise().minCoeff();
  const Vec3 high = mesh.positions.colwise().maxCoeff();
  const Vec3 middle = low + (high - low) / 2;
  mesh.positions.rowwise() -= middle.transpose();
  return high - low;
}

/// Metres per unit of the file.
double scale_of(const SceneBody& body, const std::string& name, double length, const Console& console) {
  if (body.scale) return *body.scale;
  if (!body.size) {
    console.note(fmt::format("size: {} is {:.4g} file units long, drawn {} m long; say --size to choose", name, length,
                             kDefaultSize));
  }
  return body.size.value_or(kDefaultSize) / length;
}

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
    chosen.back().first_triangle = static_cast<int>(first - triangles.begin());
    chosen.back().triangle_count = static_cast<int>(last - first);
  }
  return chosen;
}

/// Whether finding the solid turned its triangle `t` over.
bool is_turned(const SurfaceMesh& mesh, const Solid& solid, int t) {
  const auto original = [&](int corner) {
    return mesh.positions.row(mesh.triangles(solid.source[static_cast<std::size_t>(t)], corner % 3));
  };
  const auto oriented = [&](int corner) { return solid.points.row(solid.triangles(t, corner)); };
  for (int corner = 0; corner < 3; ++corner) {
    if (original(corner) == oriented(0)) return original(corner + 1) != oriented(1);
  }
  return false;
}

void load_mesh(const SceneBody& body, LoadedBody& loaded, const Console& console) {
  loaded.name = body.mesh.filename().string();
  loaded.mesh = read_mesh(body.mesh);
  const Vec3 extent = recentre(loaded.mesh);
  const double length = extent.maxCoeff();
  if (!(length > 0)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: all points of the mesh fall together", body.mesh.string()));
  }
  const double scale = scale_of(body, loaded.name, length, console);
  loaded.mesh.positions *= scale;
  loaded.extent = extent * scale;
  loaded.brick_size =
      body.brick_size ? *body.brick_size : scale * length / static_cast<double>(body.bricks.value_or(kDefaultBricks));
}

void load_box(const SceneBody& body, LoadedBody& loaded) {
  loaded.name = "box";
  loaded.extent = *body.box;
  loaded.brick_size = body.brick_size
                          ? *body.brick_size
                          : loaded.extent.maxCoeff() / static_cast<double>(body.bricks.value_or(kDefaultBricks));
  loaded.grid = box_grid(loaded.extent, loaded.brick_size, body.cuts);
  loaded.mesh = surface_of(*loaded.grid);
}

/// Bricks found already do not turn with the body.
void turn(const Mat3& rotation, LoadedBody& loaded) {
  if (rotation.isIdentity(0)) return;
  loaded.bricks_from_rest = rotation;
  loaded.mesh.positions = loaded.mesh.positions * rotation.transpose();
  loaded.mesh.normals = loaded.mesh.normals * rotation.transpose().cast<float>();
  loaded.grid.reset();
}

}  // namespace

SurfaceMesh submesh(const SurfaceMesh& mesh, const Solid& solid) {
  std::vector<int> order(solid.source.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return solid.source[static_cast<std::size_t>(a)] < solid.source[static_cast<std::size_t>(b)];
  });
  std::vector<int> rows;
  rows.reserve(order.size());
  for (const int t : order) rows.push_back(solid.source[static_cast<std::size_t>(t)]);
  SurfaceMesh part;
  part.triangles = mesh.triangles(rows, Eigen::all);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (is_turned(mesh, solid, order[i])) std::swap(part.triangles(row, 1), part.triangles(row, 2));
  }
  std::vector<int> new_vertex(static_cast<std::size_t>(mesh.positions.rows()), -1);
  std::vector<int> vertices;
  for (int& vertex : std::span(part.triangles.data(), static_cast<std::size_t>(part.triangles.size()))) {
    int& number = new_vertex[static_cast<std::size_t>(vertex)];
    if (number < 0) {
      number = static_cast<int>(vertices.size());
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
  return part;
}

Mat3 rotation_matrix(const Vec3& degrees) {
  const Vec3 angles = degrees * std::numbers::pi / 180;
  const Eigen::AngleAxisd about_x(angles.x(), Vec3::UnitX());
  const Eigen::AngleAxisd about_y(angles.y(), Vec3::UnitY());
  const Eigen::AngleAxisd about_z(angles.z(), Vec3::UnitZ());
  return (about_z * about_y * about_x).toRotationMatrix();
}

LoadedBody load_body(const SceneBody& body, const Console& console) {
  LoadedBody loaded;
  if (body.box) {
    load_box(body, loaded);
  } else {
    load_mesh(body, loaded, console);
  }
  const std::string file = body.box ? loaded.name : body.mesh.string();
  turn(rotation_matrix(body.brick_rotation), loaded);
  Solids found = find_solids(loaded.mesh, file);
  for (const std::string& note : found.notes) console.warn(fmt::format("{}: {}", loaded.name, note));
  loaded.solids = std::move(found.solids);
  if (loaded.solids.size() > 1) loaded.grid.reset();
  return loaded;
}

}  // namespace sprung
