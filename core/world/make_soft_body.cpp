#include "core/world/make_soft_body.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/query/closest_triangle.h"
#include "core/mesh/repair/coarsen.h"
#include "core/mesh/repair/submesh.h"
#include "core/mesh/repair/weld.h"

namespace sprung {
namespace {

constexpr double kLongestSkinEdge =
    0.75;  // in bricks: follows a bending brick, with enough contact points on the ground
constexpr double kShortestContactEdge = 0.4;  // in bricks, except where the mesh has longer edges only
constexpr double kShortestInThickness = 0.4;  // in thicknesses of a thin body: a plate keeps both of its sides

/// Sums of the triangles' areas, with their normals, at each point.
Points outward_at(const Points& points, const Triangles& triangles) {
  Points sums = Points::Zero(points.rows(), 3);
  for (const auto& corners : triangles.rowwise()) {
    const Vec3 a = points.row(corners[0]);
    const Vec3 b = points.row(corners[1]);
    const Vec3 area = (b - a).cross(Vec3(points.row(corners[2])) - a);
    for (const int corner : corners) sums.row(corner) += area.transpose();
  }
  return sums;
}

/// Of a plate its thickness, of other bodies some part of their width: twice the volume over the area.
double thickness_of(const Points& points, const Triangles& triangles) {
  double volume = 0;
  double area = 0;
  for (const auto& corners : triangles.rowwise()) {
    const Vec3 a = points.row(corners[0]);
    const Vec3 b = points.row(corners[1]);
    const Vec3 c = points.row(corners[2]);
    volume += a.dot(b.cross(c)) / 6;
    area += (b - a).cross(c - a).norm() / 2;
  }
  return area > 0 ? 2 * std::abs(volume) / area : 0;
}

/// By point of a skin: the row of the triangle of its coarse surface that is nearest to it.
std::vector<int> triangles_beneath(const CoarseSurface& surface, const Points& skin) {
  const NearestTriangle nearest(surface.points, surface.triangles);
  std::vector<int> rows;
  for (const auto& point : skin.rowwise()) rows.push_back(nearest.at(point.transpose()).triangle);
  return rows;
}

/// Makes the contact points: each position that triangles use, once, no finer than the bricks can follow.
void add_contacts(const Skin& skin, SoftBody& body) {
  const std::vector<int> point_of = weld_points(skin.positions);
  const auto position_of = [&](int vertex) { return point_of[vertex]; };
  std::vector<int> rows;
  for (const int vertex : std::span(skin.triangles.data(), skin.triangles.size())) {
    rows.push_back(position_of(vertex));
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const Triangles triangles = skin.triangles.unaryExpr(
      [&](int vertex) { return int(std::lower_bound(rows.begin(), rows.end(), position_of(vertex)) - rows.begin()); });
  const Points points = skin.positions(rows, Eigen::all);
  const double shortest =
      std::min(kShortestContactEdge * body.grid.brick_size, kShortestInThickness * thickness_of(points, triangles));
  const CoarseSurface surface = coarsen(points, triangles, shortest);
  body.contact.points = embed(body.grid, surface.points, outward_at(surface.points, surface.triangles));
  body.contact.triangles = surface.triangles;
  if (surface.triangles.rows() == triangles.rows()) return;  // nothing was collapsed
  const std::vector<int> beneath = triangles_beneath(surface, points);
  body.contact.beneath.assign(point_of.size(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) body.contact.beneath[rows[i]] = beneath[i];
}

}  // namespace

SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                        const Material& material, bool can_touch) {
  SoftBody body(make_body(std::move(grid), model, material));
  body.drawn.mesh = std::make_shared<const SurfaceMesh>(submesh(mesh, solid));
  body.drawn.skin = make_skin(*body.drawn.mesh, {.max_edge = kLongestSkinEdge * body.grid.brick_size});
  body.drawn.embedding = embed(body.grid, body.drawn.skin.positions, body.drawn.skin.normals);
  if (can_touch) add_contacts(body.drawn.skin, body);
  body.contact.with_itself = solid.closed && !solid.overlaps && solid.thickness == 0;
  return body;
}

EmbeddedSkin smooth_skin(const SoftBody& body, double tolerance) {
  const std::vector<Eigen::Vector3i>& cells = body.grid.cells;
  const bool has_several_in_cell = std::adjacent_find(cells.begin(), cells.end()) != cells.end();
  const bool can_embed = !body.grid.patches.empty() || !has_several_in_cell;  // caches have no patches
  if (body.drawn.mesh == nullptr || !can_embed) return {body.drawn.skin, body.drawn.embedding};
  EmbeddedSkin smooth{.skin = make_skin(*body.drawn.mesh, {.is_smooth = true}), .embedding = {}};
  refine_curves(smooth.skin, tolerance);
  refine(smooth.skin, kLongestSkinEdge * body.grid.brick_size);
  smooth.embedding = embed(body.grid, smooth.skin.positions, smooth.skin.normals);
  return smooth;
}

}  // namespace sprung
