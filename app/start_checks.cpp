#include "app/start_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/units.h"
#include "core/error.h"
#include "core/world/near_boxes.h"

namespace sprung {
namespace {

/// Of the contact points that can move, m.
Points free_points(const Actor& actor) {
  std::vector<bool> is_held(static_cast<std::size_t>(actor.body.node_count()));
  for (const HeldNode& held : actor.pinned) is_held[static_cast<std::size_t>(held.node)] = true;
  const Points points = deform_points(actor.body.grid, actor.contacts, actor.body.positions);
  std::vector<int> rows;
  for (int point = 0; point < points.rows(); ++point) {
    const auto brick = static_cast<std::size_t>(actor.contacts.brick[static_cast<std::size_t>(point)]);
    const auto& nodes = actor.body.grid.nodes[brick];
    const bool is_free =
        std::any_of(nodes.begin(), nodes.end(), [&](int node) { return !is_held[static_cast<std::size_t>(node)]; });
    if (is_free) rows.push_back(point);
  }
  return points(rows, Eigen::all);
}

template <class Distance>
double deepest(const Points& points, const Distance& distance) {
  double depth = 0;
  for (int row = 0; row < points.rows(); ++row) depth = std::max(depth, -distance(Vec3(points.row(row))));
  return depth;
}

std::string allowance(const Actor& actor) {
  return fmt::format("may overlap it by one brick ({}) at most",
                     readable(actor.body.grid.brick_size, Dimension::kLength));
}

void check_obstacle(const Scene& scene, const Production& production, std::size_t actor, std::size_t row) {
  const Obstacle& obstacle = production.world.obstacles[row];
  const Actor& body = production.world.actors[actor];
  const double depth = deepest(
      free_points(body), [&](const Vec3& place) { return gap_to(obstacle.shape, obstacle.pose, place).distance; });
  if (depth <= body.body.grid.brick_size) return;
  const std::size_t index = production.origins[actor].body;
  const std::string deep = readable(depth, Dimension::kLength);
  const std::optional<double> ground = ground_height(obstacle);
  if (!ground) {
    throw Error(ErrorKind::kBadInput, fmt::format("body {} starts {} inside obstacle {}; a body {}: move one of them",
                                                  index + 1, deep, row + 1, allowance(body)));
  }
  const double y = scene.bodies[index].position.y();
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("body {} starts {} below the ground (y = {:.6g} m); a body {}: raise its position from y = "
                  "{:.6g} m to {:.6g} m or lower the ground",
                  index + 1, deep, *ground, allowance(body), y, std::abs(y + depth) < 1e-9 * depth ? 0 : y + depth));
}

void check_pair(const Production& production, std::size_t a, std::size_t b) {
  const Actor& one = production.world.actors[a];
  const Actor& other = production.world.actors[b];
  if (other.contact_triangles.rows() == 0) return;
  const MeshDistance surface(deform_points(other.body.grid, other.contacts, other.body.positions),
                             other.contact_triangles);
  const double depth = deepest(free_points(one), [&](const Vec3& place) { return surface.nearest(place).distance; });
  const double allowed = std::min(one.body.grid.brick_size, other.body.grid.brick_size);
  if (depth <= allowed) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("body {} starts {} inside body {}; bodies may overlap by one brick ({}) at most: move them "
                          "apart, or let bodies not touch each other ([contact] bodies = false)",
                          production.origins[a].body + 1, readable(depth, Dimension::kLength),
                          production.origins[b].body + 1, readable(allowed, Dimension::kLength)));
}

}  // namespace

void check_start(const Scene& scene, const Production& production) {
  const World& world = production.world;
  std::vector<AlignedBox> boxes;
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    const Points& x = world.actors[i].body.positions;
    boxes.emplace_back(Vec3(x.colwise().minCoeff()), Vec3(x.colwise().maxCoeff()));
    for (std::size_t row = 0; row < world.obstacles.size(); ++row) check_obstacle(scene, production, i, row);
  }
  if (!world.bodies_touch) return;
  for (const auto& [a, b] : overlapping_boxes(boxes)) {
    check_pair(production, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    check_pair(production, static_cast<std::size_t>(b), static_cast<std::size_t>(a));
  }
}

}  // namespace sprung
