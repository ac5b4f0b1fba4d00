#include "app/inspect/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/console/console.h"
#include "app/console/material_json.h"
#include "core/dynamics/explicit/integrator.h"
#include "core/mesh/repair/weld.h"
#include "core/simulation/thin_part_error.h"
#include "core/skin/skin.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

/// Whether every edge between positions has two triangles or more; triangles without three distinct corners do not
/// count.
bool is_closed(const Triangles& triangles, const std::vector<int>& point_of) {
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> corners{};
    for (int c = 0; c < 3; ++c) corners[c] = point_of[triangles(t, c)];
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
  const std::vector<int> point_of = weld_points(body.mesh.positions);
  std::set<int> used;
  for (const int vertex : std::span(body.mesh.triangles.data(), body.mesh.triangles.size())) {
    used.insert(point_of[vertex]);
  }
  facts.vertices = long(used.size());
  facts.triangles = body.mesh.triangles.rows();
  facts.parts = long(body.mesh.parts.size());
  facts.solids = long(body.solids.size());
  facts.is_closed = is_closed(body.mesh.triangles, point_of);
  for (const Solid& solid : body.solids) facts.volume += solid.volume / (unit * unit * unit);
  facts.thin = body.thinnest_wall() / body.extent.maxCoeff();
  facts.median = thickness_quantile(body.walls, 0.5) / body.extent.maxCoeff();
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
  facts.min_fill = facts.count == 0 ? least : std::min(facts.min_fill, least);
  facts.count += grid.brick_count();
  facts.nodes += grid.node_count();
  facts.solids += count_connected(grid);
  facts.divided += shared_cells(grid);
  facts.volume += grid.volume();
  facts.thin_parts.insert(facts.thin_parts.end(), thin_parts.begin(), thin_parts.end());
  facts.model = body.model;
  facts.mass += body.masses.sum();
}

}  // namespace

Inspection inspect(const Preparation& prepared, const Film& film) {
  Inspection inspection;
  const std::vector<SoftBody>& bodies = prepared.simulation.world.bodies;
  for (std::size_t row = 0; row < prepared.bodies.size(); ++row) {
    const LoadedBody& body = prepared.bodies[row];
    BodyFacts facts;
    facts.name = body.name;
    facts.extent = body.extent;
    facts.material = film.bodies[row].material;
    facts.unit = 1 / body.file_from_rest.linear().col(0).norm();
    facts.mesh = mesh_facts(body, facts.unit);
    facts.bricks.size = body.brick_size;
    facts.bricks.walls = body.thinnest_wall() / body.brick_size;
    for (std::size_t at = 0; at < bodies.size(); ++at) {
      const Origin& origin = prepared.simulation.origins[at];
      if (origin.body != row || origin.copy != 0) continue;
      add_bricks(bodies[at], prepared.thin_parts[at], facts.bricks);
    }
    double volume = 0;
    for (const Solid& solid : body.solids) volume += solid.volume;
    facts.bricks.volume_error = facts.bricks.volume / volume - 1;
    inspection.bodies.push_back(std::move(facts));
  }
  inspection.stable_step = stable_step(prepared.simulation.world);
  inspection.forecast = make_forecast(prepared.simulation, film);
  return inspection;
}

namespace {

/// The volume in the unit with the shortest number: "1.2 cm3".
std::string readable_volume(double volume) {
  if (volume >= 1) return fmt::format("{:.4g} m3", volume);
  if (volume >= 1e-6) return fmt::format("{:.4g} cm3", volume * 1e6);
  return fmt::format("{:.4g} mm3", volume * 1e9);
}

std::string line(std::string_view name, const std::string& text) { return fmt::format("  {:<12}{}\n", name, text); }

std::string mesh_lines(const BodyFacts& body) {
  const MeshFacts& mesh = body.mesh;
  std::string text = line("mesh", fmt::format("{}, {}, {}, {}, {}", count_of(mesh.vertices, "vertex", "vertices"),
                                              count_of(mesh.triangles, "triangle"), count_of(mesh.parts, "part"),
                                              count_of(mesh.solids, "solid"), mesh.is_closed ? "closed" : "open"));
  text += line("volume", fmt::format("{:.4g} file units cubed, {}", mesh.volume,
                                     readable_volume(body.bricks.volume / (1 + body.bricks.volume_error))));
  const double longest = body.extent.maxCoeff();
  if (mesh.median > 0) {
    text +=
        line("thickness", fmt::format("1 % of the surface below {:.3g} % of the longest side ({}), half below {:.3g} % "
                                      "({})",
                                      100 * mesh.thin, readable(mesh.thin * longest, Dimension::kLength),
                                      100 * mesh.median, readable(mesh.median * longest, Dimension::kLength)));
  }
  for (const Repair& repair : mesh.repairs) text += line("repair", repair.text);
  return text;
}

std::string brick_lines(const BodyFacts& body) {
  const BrickFacts& bricks = body.bricks;
  std::string text =
      line("bricks", fmt::format("{} of {}, {}, {}", bricks.count, readable(bricks.size, Dimension::kLength),
                                 count_of(bricks.nodes, "node"), count_of(bricks.solids, "connected piece")));
  if (bricks.divided > 0) {
    text +=
        line("", fmt::format("{} share their cell with another piece of the solid", count_of(bricks.divided, "brick")));
  }
  text += line("fill", fmt::format("{:.2g} at least; volume {:+.2g} % of the mesh's", bricks.min_fill,
                                   100 * bricks.volume_error));
  for (std::size_t i = 0; i < std::min<std::size_t>(bricks.thin_parts.size(), 3); ++i) {
    const ThinPart& part = bricks.thin_parts[i];
    const std::string error =
        bricks.model == Model::kCalibrated
            ? fmt::format(": bends up to {:.0f} % too little where curved", 100 * missing_bend(part.across))
            : "";
    text +=
        line("thin part", fmt::format("{}, about {} thick, {:.2g} of a brick{}", count_of(part.bricks.size(), "brick"),
                                      readable(part.thickness, Dimension::kLength), part.across, error));
  }
  if (bricks.thin_parts.size() > 3) {
    text += line("", fmt::format("and {} more parts thinner than a brick", bricks.thin_parts.size() - 3));
  }
  if (bricks.model == Model::kCalibrated && bricks.walls > 1 && bricks.walls < kResolvedWall) {
    text +=
        line("walls", fmt::format("the thinnest {:.2g} bricks thick: bend up to {:.0f} % too little where curved or "
                                  "meeting",
                                  bricks.walls, std::ceil(100 * missing_bend(bricks.walls))));
  }
  return text + line("mass", fmt::format("{:.4g} kg", bricks.mass));
}

std::string forecast_lines(const Inspection& inspection) {
  const Forecast& forecast = inspection.forecast;
  std::string text = fmt::format("stable step {}", readable(inspection.stable_step, Dimension::kTime));
  if (forecast.plan) text += fmt::format(", {} steps a frame as planned", forecast.plan->steps.count);
  text += fmt::format("\nforecast    {:.0f} MB", forecast.memory / 1e6);
  if (forecast.seconds_simulating) {
    const double frame = *forecast.seconds_simulating + forecast.seconds_drawing;
    text += fmt::format(", {:.2g} s a frame ({:.2g} s to move, {:.2g} s to draw), {} for {} frames", frame,
                        *forecast.seconds_simulating, forecast.seconds_drawing, duration_text(frame * forecast.frames),
                        forecast.frames);
  } else {
    text += fmt::format(", {:.2g} s to draw a frame", forecast.seconds_drawing);
  }
  return text + "\n";
}

/// Null if the value is not known.
Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }
Json or_null(double thickness) { return thickness > 0 ? Json(thickness) : Json(); }

Json json_of(const MeshFacts& mesh) {
  Json repairs = Json::array();
  for (const Repair& repair : mesh.repairs) {
    repairs.push_back({{"kind", repair.kind}, {"count", repair.count}, {"text", repair.text}});
  }
  return {{"vertices", mesh.vertices},
          {"triangles", mesh.triangles},
          {"parts", mesh.parts},
          {"solids", mesh.solids},
          {"closed", mesh.is_closed},
          {"volume", mesh.volume},
          {"thickness_1_percent", or_null(mesh.thin)},
          {"thickness_median", or_null(mesh.median)},
          {"repairs", repairs}};
}

Json json_of(const BrickFacts& bricks, double unit) {
  Json parts = Json::array();
  for (const ThinPart& part : bricks.thin_parts) {
    Json json{{"bricks", part.bricks.size()}, {"thickness", part.thickness}};
    json["thickness_bricks"] = part.across;
    if (bricks.model == Model::kCalibrated) json["missing_bend_if_curved"] = missing_bend(part.across);
    parts.push_back(std::move(json));
  }
  Json walls{{"thickness_bricks", or_null(bricks.walls)}};
  if (bricks.model == Model::kCalibrated && bricks.walls > 0 && bricks.walls < kResolvedWall) {
    walls["missing_bend_if_curved"] = missing_bend(bricks.walls);
  }
  return {{"count", bricks.count},
          {"nodes", bricks.nodes},
          {"size", bricks.size},
          {"solids", bricks.solids},
          {"divided", bricks.divided},
          {"min_fill", bricks.min_fill},
          {"volume", bricks.volume / (unit * unit * unit)},
          {"volume_m3", bricks.volume},
          {"volume_error", bricks.volume_error},
          {"mass", bricks.mass},
          {"walls", walls},
          {"thin_parts", parts}};
}

Json json_of(const BodyFacts& body) {
  return {{"name", body.name},
          {"unit", body.unit},
          {"extent", {body.extent.x(), body.extent.y(), body.extent.z()}},
          {"material", json_of(body.material)},
          {"mesh", json_of(body.mesh)},
          {"bricks", json_of(body.bricks, body.unit)}};
}

Json json_of(const Forecast& forecast) {
  std::optional<double> frame = forecast.seconds_simulating;
  if (frame) *frame += forecast.seconds_drawing;
  return {{"memory_bytes", std::lround(forecast.memory)},
          {"seconds_per_frame", or_null(frame)},
          {"seconds_moving", or_null(forecast.seconds_simulating)},
          {"seconds_drawing", forecast.seconds_drawing},
          {"frames", forecast.frames},
          {"steps_per_frame", forecast.plan ? Json(forecast.plan->steps.count) : Json()}};
}

/// All bodies as one: sums, and the smallest of values that do not add up.
BodyFacts together(const std::vector<BodyFacts>& bodies) {
  BodyFacts all = bodies.front();
  double exact_volume = all.bricks.volume / (1 + all.bricks.volume_error);
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const auto& [mesh, bricks] = std::tie(bodies[i].mesh, bodies[i].bricks);
    all.mesh.vertices += mesh.vertices;
    all.mesh.triangles += mesh.triangles;
    all.mesh.parts += mesh.parts;
    all.mesh.solids += mesh.solids;
    all.mesh.is_closed = all.mesh.is_closed && mesh.is_closed;
    all.mesh.volume += mesh.volume;
    all.mesh.thin = std::min(all.mesh.thin, mesh.thin);
    all.mesh.median = std::min(all.mesh.median, mesh.median);
    all.mesh.repairs.insert(all.mesh.repairs.end(), mesh.repairs.begin(), mesh.repairs.end());
    all.bricks.count += bricks.count;
    all.bricks.nodes += bricks.nodes;
    all.bricks.solids += bricks.solids;
    all.bricks.divided += bricks.divided;
    all.bricks.size = std::min(all.bricks.size, bricks.size);
    all.bricks.walls = std::min(all.bricks.walls, bricks.walls);
    all.bricks.min_fill = std::min(all.bricks.min_fill, bricks.min_fill);
    all.bricks.volume += bricks.volume;
    all.bricks.mass += bricks.mass;
    all.bricks.thin_parts.insert(all.bricks.thin_parts.end(), bricks.thin_parts.begin(), bricks.thin_parts.end());
    exact_volume += bricks.volume / (1 + bricks.volume_error);
  }
  all.bricks.volume_error = all.bricks.volume / exact_volume - 1;
  return all;
}

}  // namespace

std::string inspection_text(const Inspection& inspection) {
  std::string text;
  for (const BodyFacts& body : inspection.bodies) {
    text += fmt::format("{}  {} x {} x {}\n", body.name, readable(body.extent.x(), Dimension::kLength),
                        readable(body.extent.y(), Dimension::kLength), readable(body.extent.z(), Dimension::kLength));
    text += mesh_lines(body) + brick_lines(body);
  }
  return text + forecast_lines(inspection);
}

std::string inspection_json(const Inspection& inspection) {
  const BodyFacts all = together(inspection.bodies);
  Json bodies = Json::array();
  for (const BodyFacts& body : inspection.bodies) bodies.push_back(json_of(body));
  const Json json{{"mesh", json_of(all.mesh)},
                  {"bricks", json_of(all.bricks, all.unit)},
                  {"stable_step", inspection.stable_step},
                  {"forecast", json_of(inspection.forecast)},
                  {"warnings", inspection.warnings},
                  {"bodies", bodies}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sprung
