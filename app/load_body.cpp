#include "app/load_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <sstream>

#include "app/box_shape.h"
#include "app/units.h"
#include "core/count_of.h"
#include "core/error.h"
#include "core/mesh/crossings.h"
#include "core/mesh/read/file_checks.h"
#include "core/mesh/read_mesh.h"
#include "render/decode.h"

namespace sprung {
namespace {

/// Sizes between a mesh and its origin from which on single precision rounds its shape by more than a thousandth.
constexpr double kFarAway = 1e4;

/// The bounding box of a mesh, in units of its file.
struct Bounds {
  Vec3 middle;
  Vec3 extent;
};

/// In double and before anything else, so that a mesh far from its origin loses nothing later.
Bounds recentre(SurfaceMesh& mesh) {
  const Vec3 low = mesh.positions.colwise().minCoeff();
  const Vec3 high = mesh.positions.colwise().maxCoeff();
  const Vec3 middle = low + (high - low) / 2;
  mesh.positions.rowwise() -= middle.transpose();
  return {.middle = middle, .extent = high - low};
}

void warn_if_far_away(const SceneBody& body, const SurfaceMesh& mesh, double sizes, const Console& console) {
  if (sizes < kFarAway || !mesh.single_precision) return;
  console.warn(
      fmt::format("{}: lies {:.2g} times its size from the origin of its file; in the single precision of its format, "
                  "that moves its points by up to {:.1g} of its size; move it to the origin in a mesh editor",
                  body.mesh.filename().string(), sizes, sizes * std::numeric_limits<float>::epsilon() / 2));
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

/// In place of every material of the file.
void put_on_texture(const SceneBody& body, SurfaceMesh& mesh) {
  if (mesh.uvs.rows() == 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has no UVs, which say where the texture '{}' goes; unwrap it in a mesh editor",
                            body.mesh.string(), body.texture.string()));
  }
  check_readable(body.texture);
  std::ostringstream stream;
  stream << std::ifstream(body.texture, std::ios::binary).rdbuf();
  const std::string bytes = stream.str();
  SurfaceMaterial material{.name = "texture", .color = Eigen::Vector4f::Ones(), .texture = {}, .texture_name = {}};
  material.texture.resize(bytes.size());
  std::memcpy(material.texture.data(), bytes.data(), bytes.size());
  material.texture_name = body.texture.filename().string();
  static_cast<void>(decode_pixels(material.texture, body.texture.string()));  // before any work is lost
  mesh.materials = {std::move(material)};
  for (Part& part : mesh.parts) part.material = 0;
}

void load_mesh(const SceneBody& body, LoadedBody& loaded, const Console& console) {
  loaded.name = body.mesh.filename().string();
  loaded.mesh = read_mesh(body.mesh);
  for (const std::string& note : loaded.mesh.notes) console.warn(fmt::format("{}: {}", loaded.name, note));
  if (!body.texture.empty()) put_on_texture(body, loaded.mesh);
  const auto [middle, extent] = recentre(loaded.mesh);
  const double length = extent.maxCoeff();
  if (!(length > 0)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: all points of the mesh fall together{}", body.mesh.string(),
                            middle.norm() > 0 ? ", perhaps because they lie too far from the origin" : ""));
  }
  warn_if_far_away(body, loaded.mesh, middle.norm() / length, console);
  const double scale = scale_of(body, loaded.name, length, console);
  loaded.mesh.positions *= scale;
  loaded.extent = extent * scale;
  loaded.file_from_rest = Eigen::Translation3d(middle) * Eigen::Scaling(1 / scale);
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

/// Such bricks would not show the body at all.
void refuse_giant_bricks(const LoadedBody& loaded) {
  constexpr double kRounding = 1e-9;
  const double longest = loaded.extent.maxCoeff();
  if (loaded.brick_size <= longest * (1 + kRounding)) return;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: a brick of {} is larger than the body, whose longest side is {}; "
                                                "give a smaller --brick-size, or --bricks",
                                                loaded.name, readable(loaded.brick_size, Dimension::kLength),
                                                readable(longest, Dimension::kLength)));
}

/// The bricks do not need a surface that keeps clear of itself, but what overlaps becomes one.
void report_crossings(const Console& console, LoadedBody& loaded) {
  int pairs = 0;
  Vec3 place = Vec3::Zero();
  for (const Solid& solid : loaded.solids) {
    const Crossings found = find_crossings(solid.points, solid.triangles);
    if (pairs == 0 && found.pairs > 0) {
      const Vec3 middle = solid.points(solid.triangles.row(found.first[0]), Eigen::all).colwise().mean();
      place = loaded.file_from_rest * (loaded.bricks_from_rest.transpose() * middle);
    }
    pairs += found.pairs;
  }
  loaded.crosses_itself = pairs > 0;
  if (pairs == 0) return;
  console.warn(fmt::format(
      "{}: the surface crosses itself: {}, the first near ({:.4g}, {:.4g}, {:.4g}) of the file; "
      "what overlaps is filled once",
      loaded.name, count_of(pairs, "pair of triangles", "pairs of triangles"), place.x(), place.y(), place.z()));
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
  refuse_giant_bricks(loaded);
  const std::string file = body.box ? loaded.name : body.mesh.string();
  turn(rotation_matrix(body.brick_rotation), loaded);
  Solids found = find_solids(loaded.mesh, file);
  for (const std::string& note : notes_of(found.repairs)) console.warn(fmt::format("{}: {}", loaded.name, note));
  loaded.repairs = std::move(found.repairs);
  loaded.solids = std::move(found.solids);
  if (loaded.solids.size() > 1) loaded.grid.reset();
  if (!body.box) report_crossings(console, loaded);
  return loaded;
}

}  // namespace sprung
