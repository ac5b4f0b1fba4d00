#include "core/simulation/soft_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/bricks/pieces.h"
#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/mesh/repair/coarsen.h"
#include "core/mesh/repair/submesh.h"
#include "core/skin/skin.h"

namespace sprung {
namespace {

constexpr double kLongestSkinEdge =
    0.75;  // in bricks: follows the bend of a brick, and touches the ground often enough
constexpr double kShortestContactEdge = 0.4;  // in bricks, but where the mesh has longer ones only

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

/// Lets the skin touch: each position that triangles use, once; finer than the bricks can follow it need not be.
void add_contacts(const Skin& skin, Actor& actor) {
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
  const double shortest = kShortestContactEdge * actor.body.grid.brick_size;
  const CoarseSurface surface = coarsen(skin.positions(rows, Eigen::all), triangles, shortest);
  actor.contacts = embed(actor.body.grid, surface.points, outward_at(surface.points, surface.triangles));
  actor.contact_triangles = surface.triangles;
}

void check_options(const std::string& name, const FillOptions& options) {
  check_material(options.material);
  if (options.size > 0 && options.bricks > 0) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: size ({:g} m) and bricks ({}) must be above 0", name, options.size, options.bricks));
}

}  // namespace

SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                        const Material& material) {
  SoftBody made;
  made.actor.body = make_body(std::move(grid), model, material);
  const BrickGrid& bricks = made.actor.body.grid;
  made.skin = make_skin(submesh(mesh, solid), {.max_edge = kLongestSkinEdge * bricks.brick_size});
  made.embedding = embed(bricks, made.skin.positions, made.skin.normals);
  add_contacts(made.skin, made.actor);
  made.actor.collides_with_itself = solid.closed && !solid.overlaps && solid.thickness == 0;
  return made;
}

MeshBox recentre(SurfaceMesh& mesh) {
  Vec3 low = mesh.positions.row(mesh.triangles(0, 0));
  Vec3 high = low;
  for (const int vertex : mesh.triangles.reshaped()) {
    low = low.cwiseMin(mesh.positions.row(vertex).transpose());
    high = high.cwiseMax(mesh.positions.row(vertex).transpose());
  }
  const Vec3 middle = low + (high - low) / 2;
  mesh.positions.rowwise() -= middle.transpose();
  return {.middle = middle, .extent = high - low};
}

std::vector<SoftBody> fill_mesh(SurfaceMesh mesh, const std::string& name, const FillOptions& options) {
  check_options(name, options);
  const Vec3 extent = recentre(mesh).extent;
  if (!(extent.maxCoeff() > 0)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: all points of the mesh fall together", name));
  }
  const double scale = options.size / extent.maxCoeff();
  mesh.positions *= scale;
  std::vector<SoftBody> bodies;
  for (Solid& solid : find_solids(mesh, name, {.repair = options.repair}).solids) {
    solid.volume = enclosed_volume(solid);
    BrickGrid grid = voxelize(solid, options.size / options.bricks);
    split_pieces(solid, grid);
    absorb_slivers(grid);
    bodies.push_back(make_soft_body(mesh, solid, std::move(grid), options.model, options.material));
    place(bodies.back().actor.body, Mat3::Identity(), options.position + Vec3(0, scale * extent.y() / 2, 0));
  }
  return bodies;
}

}  // namespace sprung
