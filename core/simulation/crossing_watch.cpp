#include "core/simulation/crossing_watch.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "core/contact/watch/crossing_pairs.h"

namespace sprung {
namespace {

constexpr double kBarely = 1e-6;  // of the size, that a skin may reach behind a plane: rounding

std::vector<const Points*> nodes_of(const World& world) {
  std::vector<const Points*> nodes;
  for (const SoftBody& body : world.bodies) nodes.push_back(&body.positions);
  return nodes;
}

std::uint64_t vertex_pair(int a, int b) { return std::uint64_t(a) << 32 | std::uint64_t(b); }

}  // namespace

const Crossings* deepest_of(const std::vector<Crossings>& frames) {
  const Crossings* deepest = nullptr;
  for (const Crossings& frame : frames) {
    if (frame.pairs > 0 && (deepest == nullptr || frame.depth > deepest->depth)) deepest = &frame;
  }
  return deepest;
}

CrossingWatch::CrossingWatch(const Scene& scene, const Simulation& simulation)
    : scene_(scene), simulation_(simulation) {
  const World& world = simulation.world;
  std::vector<std::optional<DrawnSurface>> of_bodies(world.bodies.size());
  tbb::parallel_for(std::size_t{0}, of_bodies.size(), [&](std::size_t i) { of_bodies[i].emplace(world.bodies[i]); });
  for (std::optional<DrawnSurface>& surface : of_bodies) surfaces_.push_back(std::move(*surface));
  for (const StageObstacle& obstacle : simulation.obstacles) {
    surfaces_.emplace_back(obstacle.skin).move_to(skin_positions(obstacle, 0));
  }
  const int bodies = isize(world.bodies);
  for (int body = 0; body < bodies; ++body) {
    tasks_.push_back({.skins{body, body}});
    for (int other = body + 1; other < bodies && scene.contact.bodies; ++other) {
      tasks_.push_back({.skins{body, other}});
    }
    for (int row = 0; row < isize(simulation.obstacles); ++row) tasks_.push_back({.skins{body, bodies + row}});
  }
  const std::vector<Found> found = find(nodes_of(world), 0);
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    Task& task = tasks_[i];
    if (task.is_self() && !found[i].pairs.empty()) {
      surfaces_[task.skins[0]].complete();
      task.tangles_at_start = tangles_of(surfaces_[task.skins[0]], found[i].pairs);
      continue;
    }
    for (const auto& pair : found[i].pairs) {
      for_each_vertex_pair(task, pair, [&](VertexPair vertices) { task.at_start.insert(vertices); });
    }
  }
}

bool CrossingWatch::is_plane(int skin) const {
  const int row = skin - isize(simulation_.world.bodies);
  return row >= 0 && std::holds_alternative<SolidHalfSpace>(simulation_.obstacles[row].shape);
}

void CrossingWatch::move(const std::vector<const Points*>& nodes, double time) {
  const std::size_t bodies = nodes.size();
  tbb::parallel_for(std::size_t{0}, surfaces_.size(), [&](std::size_t skin) {
    if (skin < bodies) {
      surfaces_[skin].follow(*nodes[skin]);
    } else if (!is_plane(int(skin)) && !simulation_.obstacles[skin - bodies].movement.is_still()) {
      surfaces_[skin].move_to(skin_positions(simulation_.obstacles[skin - bodies], time));
    }
  });
}

CrossingWatch::Plane CrossingWatch::plane_of(const Task& task, double time) const {
  const Pose pose = pose_at(simulation_.obstacles[task.skins[1] - isize(simulation_.world.bodies)], time);
  const Vec3 normal = pose.rotation.col(1);
  return {.normal = normal, .offset = normal.dot(pose.translation)};
}

RowPairs CrossingWatch::cells_of(const Task& task, double time) const {
  const DrawnSurface& surface = surfaces_[task.skins[0]];
  if (!is_plane(task.skins[1])) return cells_that_may_cross(surface, surfaces_[task.skins[1]]);
  RowPairs cells;
  const Plane plane = plane_of(task, time);
  for (int cell = 0; cell < isize(surface.cells()); ++cell) {
    const AlignedBox& box = surface.box_of(cell);
    const double lowest = plane.height(box.center()) - plane.normal.cwiseAbs().dot(box.sizes()) / 2;
    if (lowest < -kBarely * simulation_.size) cells.push_back({cell, cell});
  }
  return cells;
}

RowPairs CrossingWatch::pairs_of(const Task& task, const RowPairs& cells, double time) const {
  const DrawnSurface& surface = surfaces_[task.skins[0]];
  if (!is_plane(task.skins[1])) return crossing_pairs(surface, surfaces_[task.skins[1]], cells);
  RowPairs pairs;
  const Plane plane = plane_of(task, time);
  for (const auto& [cell, same] : cells) {
    for (int row = surface.cells()[cell].first; row < surface.cells()[cell].last; ++row) {
      const auto triangle = surface.triangles().row(row);
      const bool is_behind = std::any_of(triangle.begin(), triangle.end(), [&](int point) {
        return plane.height(surface.points().row(point)) < -kBarely * simulation_.size;
      });
      if (is_behind) pairs.push_back({row, row});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<CrossingWatch::Found> CrossingWatch::find(const std::vector<const Points*>& nodes, double time) {
  move(nodes, time);
  std::vector<Found> found(tasks_.size());
  std::vector<RowPairs> cells(tasks_.size());
  const auto for_each_task = [&](const auto& work) { tbb::parallel_for(std::size_t{0}, tasks_.size(), work); };
  for_each_task([&](std::size_t i) { cells[i] = cells_of(tasks_[i], time); });
  place_vertices(cells);
  for_each_task([&](std::size_t i) { found[i].pairs = pairs_of(tasks_[i], cells[i], time); });
  return found;
}

void CrossingWatch::place_vertices(const std::vector<RowPairs>& cells) {
  std::vector<std::vector<int>> wanted(surfaces_.size());
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      for (const auto& pair : cells[i]) wanted[tasks_[i].skins[side]].push_back(pair[side]);
    }
  }
  tbb::parallel_for(std::size_t{0}, surfaces_.size(),
                    [&](std::size_t skin) { surfaces_[skin].place_vertices(wanted[skin]); });
}

template <class Visit>
void CrossingWatch::for_each_vertex_pair(const Task& task, const std::array<int, 2>& pair, const Visit& visit) const {
  const Triangles& first = surfaces_[task.skins[0]].triangles();
  const bool has_plane = is_plane(task.skins[1]);
  for (const int a : first.row(pair[0])) {
    if (has_plane) {
      visit(vertex_pair(a, a));
      continue;
    }
    for (const int b : surfaces_[task.skins[1]].triangles().row(pair[1])) {
      visit(vertex_pair(a, b));
    }
  }
}

bool CrossingWatch::was_at_start(const Task& task, const std::array<int, 2>& pair) const {
  if (!task.tangles_at_start.empty()) {
    for (const int a : surfaces_[task.skins[0]].triangles().row(pair[0])) {
      for (const int b : surfaces_[task.skins[0]].triangles().row(pair[1])) {
        if (task.tangles_at_start[a] != 0 && task.tangles_at_start[a] == task.tangles_at_start[b]) return true;
      }
    }
    return false;
  }
  bool is_known = false;
  for_each_vertex_pair(task, pair,
                       [&](VertexPair vertices) { is_known = is_known || task.at_start.contains(vertices); });
  return is_known;
}

CrossingDepth CrossingWatch::depth_of(const Task& task, const RowPairs& pairs, double time) const {
  const DrawnSurface& surface = surfaces_[task.skins[0]];
  if (!is_plane(task.skins[1])) {
    return crossing_depth(surface, surfaces_[task.skins[1]], pairs, task.tangles_at_start);
  }
  const Plane plane = plane_of(task, time);
  CrossingDepth deepest;
  for (const auto& pair : pairs) {
    for (const int point : surface.triangles().row(pair[0])) {
      const double depth = -plane.height(surface.points().row(point));
      if (depth > deepest.depth) deepest = {.depth = depth, .position = surface.points().row(point)};
    }
  }
  return deepest;
}

Crossings CrossingWatch::look(const std::vector<const Points*>& nodes, int frame, double time) {
  std::vector<Found> found = find(nodes, time);
  std::vector<char> crosses(surfaces_.size());
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    Found& of_task = found[i];
    const std::size_t all = of_task.pairs.size();
    if (!tasks_[i].at_start.empty() || !tasks_[i].tangles_at_start.empty()) {
      std::erase_if(of_task.pairs, [&](const auto& pair) { return was_at_start(tasks_[i], pair); });
    }
    of_task.at_start = long(all - of_task.pairs.size());
    if (of_task.pairs.empty() || is_plane(tasks_[i].skins[1])) continue;
    for (const int skin : tasks_[i].skins) crosses[skin] = 1;
  }
  tbb::parallel_for(std::size_t{0}, surfaces_.size(), [&](std::size_t skin) {
    if (crosses[skin] != 0) surfaces_[skin].complete();
  });
  tbb::parallel_for(std::size_t{0}, tasks_.size(), [&](std::size_t i) {
    if (!found[i].pairs.empty()) found[i].depth = depth_of(tasks_[i], found[i].pairs, time);
  });
  Crossings crossings{.frame = frame, .time = time};
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    crossings.pairs += long(found[i].pairs.size());
    crossings.pairs_at_start += found[i].at_start;
    if (!found[i].pairs.empty() && (crossings.skins[0] < 0 || found[i].depth.depth > crossings.depth)) {
      crossings.depth = found[i].depth.depth;
      crossings.position = found[i].depth.position;
      crossings.skins = tasks_[i].skins;
    }
    add_corners(tasks_[i], found[i].pairs, corners);
  }
  crossings.share = crossings.depth / simulation_.size;
  if (crossings.pairs > 0) crossings.names = names_of(crossings.skins);
  crossing_triangles_.resize(Eigen::Index(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) crossing_triangles_.row(Eigen::Index(i)) = corners[i].transpose();
  return crossings;
}

void CrossingWatch::add_corners(const Task& task, const RowPairs& pairs, std::vector<Vec3>& corners) const {
  const bool has_obstacle = task.skins[1] >= isize(simulation_.world.bodies);
  for (std::size_t side = 0; side < (has_obstacle ? 1 : 2); ++side) {
    const DrawnSurface& surface = surfaces_[task.skins[side]];
    for (const auto& pair : pairs) {
      for (const int vertex : surface.triangles().row(pair[side])) corners.emplace_back(surface.points().row(vertex));
    }
  }
}

std::string CrossingWatch::name_of(int skin) const {
  const int bodies = isize(simulation_.world.bodies);
  if (skin >= bodies) return fmt::format("obstacle {}", skin - bodies + 1);
  const Origin& origin = simulation_.origins[skin];
  const std::string file = scene_.bodies[origin.body].mesh.filename().string();
  return fmt::format("body {}{}{}", origin.body + 1, origin.copy > 0 ? fmt::format(", copy {}", origin.copy + 1) : "",
                     file.empty() ? "" : fmt::format(" ({})", file));
}

std::string CrossingWatch::names_of(const std::array<int, 2>& skins) const {
  if (skins[0] == skins[1]) return name_of(skins[0]) + " and itself";
  return fmt::format("{} and {}", name_of(skins[0]), name_of(skins[1]));
}

}  // namespace sprung
