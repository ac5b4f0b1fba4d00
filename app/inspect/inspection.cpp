#include "app/inspect/inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/dynamics/explicit/integrator.h"
#include "core/skin/skin.h"

namespace sprung {
namespace {

/// Whether every edge between places has two triangles or more; triangles without three corners do not count.
bool is_closed(const Triangles& triangles, const std::vector<int>& place_of) {
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> corners{};
    for (int c = 0; c < 3; ++c) corners[c] = place_of[triangles(t, c)];
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(corners[c], corners[(c + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    if (next - edge < 2) return false;
    edge = next;
  }
  return true;
}

MeshFacts mesh_facts(const LoadedBody& body, double unit) {
  MeshFacts facts;
  const std::vector<int> place_of = weld_points(body.mesh.positions);
  std::set<int> used;
  for (const int vertex : std::span(body.mesh.triangles.data(), body.mesh.triangles.size())) {
    used.insert(place_of[vertex]);
  }
  facts.vertices = long(used.size());
  facts.triangles = body.mesh.triangles.rows();
  facts.parts = long(body.mesh.parts.size());
  facts.solids = long(body.solids.size());
  facts.is_closed = is_closed(body.mesh.triangles, place_of);
  for (const Solid& solid : body.solids) facts.volume += solid.volume / (unit * unit * unit);
  std::vector<WallSample> all;
  for (const auto& walls : body.walls) all.insert(all.end(), walls.begin(), walls.end());
  facts.thin = thickness_quantile(all, 0.01) / body.extent.maxCoeff();
  facts.median = thickness_quantile(all, 0.5) / body.extent.maxCoeff();
  facts.repairs = body.repairs;
  return facts;
}

long shared_cells(const BrickGrid& grid) {
  long count = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const bool before = i > 0 && grid.cells[i - 1] == grid.cells[i];
    const bool after = i + 1 < grid.cells.size() && grid.cells[i + 1] == grid.cells[i];
    count += before || after ? 1 : 0;
  }
  return count;
}

void add_bricks(const Body& body, const std::vector<ThinPart>& thin_parts, BrickFacts& facts) {
  const BrickGrid& grid = body.grid;
  const double least = *std::min_element(grid.fill.begin(), grid.fill.end());
  facts.least_fill = facts.count == 0 ? least : std::min(facts.least_fill, least);
  facts.count += grid.brick_count();
  facts.nodes += grid.node_count();
  facts.solids += count_connected(grid);
  facts.divided += shared_cells(grid);
  facts.volume += grid.volume();
  facts.thin_parts.insert(facts.thin_parts.end(), thin_parts.begin(), thin_parts.end());
  facts.mass += body.masses.sum();
}

}  // namespace

Inspection inspect(const Preparation& prepared, const Scene& scene) {
  Inspection inspection;
  std::size_t actor = 0;
  for (const LoadedBody& body : prepared.bodies) {
    BodyFacts facts;
    facts.name = body.name;
    facts.extent = body.extent;
    facts.unit = 1 / body.file_from_rest.linear().col(0).norm();
    facts.mesh = mesh_facts(body, facts.unit);
    facts.bricks.size = body.brick_size;
    for (std::size_t solid = 0; solid < body.solids.size(); ++solid, ++actor) {
      add_bricks(prepared.production.world.actors[actor].body, prepared.thin_parts[actor], facts.bricks);
    }
    double volume = 0;
    for (const Solid& solid : body.solids) volume += solid.volume;
    facts.bricks.volume_error = facts.bricks.volume / volume - 1;
    inspection.bodies.push_back(std::move(facts));
  }
  inspection.stable_step = stable_step(prepared.production.world);
  inspection.forecast = make_forecast(prepared.production, scene);
  return inspection;
}

}  // namespace sprung
