#include "core/simulation/selector.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/color_text.h"
#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/query/winding_tree.h"
#include "core/mesh/repair/faces.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr double kSelectionRounding = 1e-9;  // of the longest side
constexpr double kSurfaceRounding = 1e-6;    // of the longest side: that of a file's floats
constexpr int kBorderCuts = 5;               // of a triangle, in four: to a few hundredths of a brick
constexpr double kAlmostHalf = 0.49;         // of a brick; not quite half, where rounding errors would decide
constexpr double kSamePaint = 2.5;           // of 255: rounding of colours in files
constexpr double kInside = 0.5;              // winding number

Vec3 middle_of(const Points& points) {
  const Vec3 low = points.colwise().minCoeff();
  const Vec3 high = points.colwise().maxCoeff();
  return (low + high) / 2;
}

std::vector<int> rows_where(const Points& points, const std::function<bool(const Vec3&)>& test) {
  std::vector<int> rows;
  for (int row = 0; row < points.rows(); ++row) {
    if (test(points.row(row))) rows.push_back(row);
  }
  return rows;
}

std::vector<int> row_nearest_to(const Vec3& position, const Points& points) {
  Eigen::Index row = 0;
  if (points.rows() == 0) return {};
  (points.rowwise() - position.transpose()).rowwise().squaredNorm().minCoeff(&row);
  return {int(row)};
}

}  // namespace

std::vector<int> Selector::nodes(const Selection& selection, const Points& positions, std::size_t solid) const {
  if (selection.nearest) {
    const Vec3 position = position_of(*selection.nearest);
    return solid_nearest_to(position) == solid ? row_nearest_to(position, positions) : std::vector<int>{};
  }
  return rows_where(positions, test_of(selection, kAlmostHalf * body_.brick_size, body_.brick_size));
}

Points brick_middles(const BrickGrid& grid) {
  Points middles(grid.brick_count(), 3);
  for (int brick = 0; brick < grid.brick_count(); ++brick) {
    middles.row(brick) = brick_middle(grid, brick).transpose();
  }
  return middles;
}

std::vector<int> Selector::bricks(const Selection& selection, const BrickGrid& grid, std::size_t solid) const {
  const Points middles = brick_middles(grid);
  if (is_whole(selection)) {
    std::vector<int> all(grid.cells.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  if (selection.nearest) {
    const Vec3 position = position_of(*selection.nearest);
    return solid_nearest_to(position) == solid ? row_nearest_to(position, middles) : std::vector<int>{};
  }
  const double margin = kSelectionRounding * body_.extent.maxCoeff();
  return rows_where(middles, test_of(selection, margin, std::numeric_limits<double>::infinity()));
}

std::vector<int> Selector::touched_bricks(const Selection& selection, const BrickGrid& grid, std::size_t solid) const {
  std::vector<int> rows = bricks(selection, grid, solid);
  if (!rows.empty() || selection.nearest) return rows;
  const double margin = grid.brick_size / 2 + kSelectionRounding * body_.extent.maxCoeff();
  return rows_where(brick_middles(grid), test_of(selection, margin, grid.brick_size));
}

std::vector<SkinPiece> Selector::skin_pieces(const Selection& selection, const Points& points,
                                             const Triangles& triangles, std::size_t solid) const {
  if (is_whole(selection)) return pieces_where(points, triangles, 0, [](const Vec3&) { return true; });
  if (selection.nearest) {
    const Vec3 position = position_of(*selection.nearest);
    if (solid_nearest_to(position) != solid || triangles.rows() == 0) return {};
    return {{.triangle = NearestTriangle(points, triangles).at(position).triangle}};
  }
  const bool has_border = selection.box || selection.sphere || selection.half_space;
  return pieces_where(points, triangles, has_border ? kBorderCuts : 0,
                      test_of(selection, kSurfaceRounding * body_.extent.maxCoeff(), body_.brick_size));
}

Vec3 Selector::position_of(const Vec3& fractions) const {
  return body_.bricks_from_rest * ((fractions.array() - 0.5) * body_.extent.array()).matrix();
}

Vec3 Selector::centre(const Selection& selection) const {
  if (selection.box) return position_of((selection.box->min.cwiseMax(0) + selection.box->max.cwiseMin(1)) / 2);
  if (selection.sphere) return position_of(selection.sphere->centre);
  if (selection.nearest) return position_of(*selection.nearest);
  if (!selection.mesh.empty()) return middle_of(read_enclosure(selection.mesh).positions);
  const Points& vertices = body_.mesh.positions;
  const std::vector<int> chosen = rows_where(vertices, test_of(selection, 0, 0));
  return chosen.empty() ? middle_of(vertices) : middle_of(vertices(chosen, Eigen::all));
}

Selector::Test Selector::test_of(const Selection& selection, double margin, double depth) const {
  if (selection.box) return test_of(*selection.box, margin);
  if (selection.sphere) {
    const double reach = selection.sphere->radius * body_.extent.maxCoeff() + margin;
    return [reach, centre = position_of(selection.sphere->centre)](const Vec3& position) {
      return (position - centre).norm() <= reach;
    };
  }
  if (selection.half_space) {
    const Vec3 normal = body_.bricks_from_rest * selection.half_space->normal.normalized();
    return [margin, normal, point = position_of(selection.half_space->point)](const Vec3& position) {
      return normal.dot(position - point) >= -margin;
    };
  }
  if (!selection.part.empty()) return nearest_to(triangles_of(selection.part), depth);
  if (selection.face) return nearest_to(face_at(position_of(*selection.face)), depth);
  if (selection.painted) return nearest_to_paint(*selection.painted, depth);
  return enclosed_by(selection.mesh);
}

/// The lattice extends a little beyond the body, so points outside its bounding box are clamped to it.
Selector::Test Selector::test_of(const Box& box, double margin) const {
  const Eigen::Array3d extent =
      body_.extent.array().max(kSelectionRounding * body_.extent.maxCoeff());  // a sheet has none
  const Eigen::Array3d low = box.min.array() - margin / extent;
  const Eigen::Array3d high = box.max.array() + margin / extent;
  return [low, high, extent, rest_from_bricks = Mat3(body_.bricks_from_rest.transpose())](const Vec3& position) {
    const Eigen::Array3d fractions = ((rest_from_bricks * position).array() / extent + 0.5).max(0).min(1);
    return (fractions >= low).all() && (fractions <= high).all();
  };
}

const NearestTriangle& Selector::surface() const {
  if (!surface_) surface_.emplace(body_.mesh.positions, body_.mesh.triangles);
  return *surface_;
}

/// Points at equal distance to another part count for both, which share their common border.
Selector::Test Selector::nearest_to(const Triangles& triangles, double depth) const {
  const auto nearest = std::make_shared<NearestTriangle>(body_.mesh.positions, triangles);
  const double rounding = kSelectionRounding * body_.extent.maxCoeff();
  return [this, nearest, rounding, deepest = depth + rounding](const Vec3& position) {
    const double distance = nearest->at(position).distance;
    return distance <= deepest && distance <= surface().at(position).distance + rounding;
  };
}

Selector::Test Selector::nearest_to_paint(const Color& paint, double depth) const {
  const double deepest = depth + kSelectionRounding * body_.extent.maxCoeff();
  return [this, deepest, chosen = vertices_of(paint)](const Vec3& position) {
    const SurfaceProjection found = surface().at(position);
    return found.distance <= deepest && chosen[nearest_vertex(found)];
  };
}

Triangles Selector::triangles_of(const std::string& part) const {
  std::vector<int> rows;
  std::vector<std::string_view> names;
  const auto material_of = [&](const Part& known) -> std::string_view {
    return known.material < 0 ? std::string_view() : body_.mesh.materials[known.material].name;
  };
  const bool is_part = std::any_of(body_.mesh.parts.begin(), body_.mesh.parts.end(),
                                   [&](const Part& known) { return known.name == part; });
  for (const Part& known : body_.mesh.parts) {
    names.push_back(known.name);
    if (!material_of(known).empty()) names.push_back(material_of(known));
    if (is_part ? known.name != part : material_of(known) != part) continue;
    for (int i = 0; i < known.triangle_count; ++i) rows.push_back(known.first_triangle + i);
  }
  if (!rows.empty()) return body_.mesh.triangles(rows, Eigen::all);
  throw Error(ErrorKind::kBadInput, fmt::format("{}: has no part '{}'{}", body_.name, part, did_you_mean(part, names)));
}

Triangles Selector::face_at(const Vec3& position) const {
  const std::vector<int> rows = find_face(body_.mesh.positions, body_.mesh.triangles, surface().at(position).triangle);
  return body_.mesh.triangles(rows, Eigen::all);
}

std::vector<bool> Selector::vertices_of(const Color& paint) const {
  const auto& colors = body_.mesh.colors;
  const Eigen::RowVector3f wanted(paint.red, paint.green, paint.blue);
  std::vector<bool> chosen(body_.mesh.positions.rows());
  for (int row = 0; row < colors.rows(); ++row) {
    const Eigen::RowVector3f levels = 255 * colors.row(row).head<3>();
    chosen[row] = (levels - wanted).cwiseAbs().maxCoeff() <= kSamePaint;
  }
  if (std::find(chosen.begin(), chosen.end(), true) != chosen.end()) return chosen;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: no vertex has the colour {}{}", body_.name, hex_text(paint),
                                                colors.rows() == 0 ? "; the mesh has no vertex colours at all" : ""));
}

int Selector::nearest_vertex(const SurfaceProjection& position) const {
  const Eigen::RowVector3i corners = body_.mesh.triangles.row(position.triangle);
  const auto distance = [&](int vertex) {
    return (body_.mesh.positions.row(vertex).transpose() - position.point).squaredNorm();
  };
  return *std::min_element(corners.begin(), corners.end(), [&](int a, int b) { return distance(a) < distance(b); });
}

SurfaceMesh Selector::read_enclosure(const std::filesystem::path& mesh) const {
  SurfaceMesh enclosure = read_mesh(mesh);
  const Eigen::Affine3d here_from_file = body_.bricks_from_rest * body_.file_from_rest.inverse();
  for (auto point : enclosure.positions.rowwise()) point = (here_from_file * Vec3(point)).transpose();
  return enclosure;
}

Selector::Test Selector::enclosed_by(const std::filesystem::path& mesh) const {
  const auto solids = std::make_shared<Solids>(find_solids(read_enclosure(mesh), mesh.string()));
  const auto trees = std::make_shared<std::vector<WindingTree>>();
  for (const Solid& solid : solids->solids) trees->emplace_back(solid.points, solid.triangles);
  return [solids, trees](const Vec3& position) {
    return std::any_of(trees->begin(), trees->end(),
                       [&](const WindingTree& tree) { return tree.at(position) > kInside; });
  };
}

std::size_t Selector::solid_nearest_to(const Vec3& position) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t solid = 0; solid < body_.solids.size(); ++solid) {
    const double distance =
        (body_.solids[solid].points.rowwise() - position.transpose()).rowwise().squaredNorm().minCoeff();
    if (distance >= least) continue;
    least = distance;
    nearest = solid;
  }
  return nearest;
}

namespace {

/// The properties of a material that may vary within a body.
struct Stuff {
  double young = 0;    // Pa
  double density = 0;  // kg/m^3
};

/// Poisson's ratio enters many constants of a brick's law, its stiffness is a single factor.
void check_ratio(const Material& material, const Material& body) {
  if (material.law != body.law) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("a region has the law {}, its body {}: the materials of one body may differ in stiffness "
                            "and density only; give both the same law",
                            law_text(material.law), law_text(body.law)));
  }
  if (material.poisson == body.poisson || material.in_motion().poisson == body.in_motion().poisson) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("a region has the Poisson's ratio {}, its body {}: the materials of one body may differ in "
                          "stiffness and density only; give both the same ratio",
                          material.poisson, body.poisson));
}

/// The material of a region at a point.
Stuff stuff_at(const Region& region, const Selector& selector, const Vec3& position) {
  const Material& first = region.material;
  if (!region.gradient) return {.young = first.young, .density = first.density};
  const Material& second = region.gradient->material;
  const Vec3 from = selector.position_of(region.gradient->from);
  const Vec3 way = selector.position_of(region.gradient->to) - from;
  const double share = std::clamp(way.dot(position - from) / way.squaredNorm(), 0.0, 1.0);
  return {.young = std::lerp(first.young, second.young, share),
          .density = std::lerp(first.density, second.density, share)};
}

}  // namespace

std::vector<int> apply_regions(const SceneBody& scene_body, const Selector& selector, Body& body, std::size_t solid) {
  const std::vector<Region>& regions = scene_body.regions;
  std::vector<int> regions_of_bricks(body.grid.cells.size(), 0);
  if (regions.empty()) return regions_of_bricks;
  const Points middles = brick_middles(body.grid);
  std::vector<Stuff> filled(body.grid.cells.size());
  for (std::size_t row = 0; row < regions.size(); ++row) {
    const Region& region = regions[row];
    check_ratio(region.material, scene_body.material);
    if (region.gradient) check_ratio(region.gradient->material, scene_body.material);
    for (const int brick : selector.bricks(region, body.grid, solid)) {
      filled[brick] = stuff_at(region, selector, middles.row(brick));
      regions_of_bricks[brick] = int(row) + 1;
    }
  }
  const double corner_mass = body.material.density * body.grid.brick_volume() / 8;
  for (std::size_t brick = 0; brick < filled.size(); ++brick) {
    if (regions_of_bricks[brick] == 0) continue;
    const double more_mass = (filled[brick].density / body.material.density - 1) * corner_mass;
    for (const int node : body.grid.nodes[brick]) body.masses[node] += more_mass * body.stiffness_scale[brick];
    body.stiffness_scale[brick] *= filled[brick].young / body.material.young;
  }
  build_tiles(body);
  return regions_of_bricks;
}

}  // namespace sprung
