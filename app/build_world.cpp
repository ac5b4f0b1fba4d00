#include "app/build_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "app/units.h"
#include "core/bricks/pieces.h"
#include "core/bricks/slivers.h"
#include "core/bricks/voxelize.h"
#include "core/count_of.h"
#include "core/error.h"
#include "core/mesh/submesh.h"
#include "core/rotation.h"
#include "core/skin/corner_normals.h"
#include "core/world/squeeze.h"

namespace sprung {
namespace {

constexpr double kLongestSkinEdge =
    0.75;  // in bricks: follows the bend of a brick, and touches the ground often enough

/// For bodies whose scene names no colour; the solids of a file differ.
constexpr std::array<Color, 8> kPalette{{{0xd8, 0x32, 0x2a},
                                         {0xf2, 0xa0, 0x3d},
                                         {0x3b, 0x8e, 0xa5},
                                         {0x6a, 0x9f, 0x4e},
                                         {0x8a, 0x5a, 0xa8},
                                         {0xe8, 0xc5, 0x47},
                                         {0xc7, 0x6b, 0x8f},
                                         {0x4f, 0x6d, 0xb8}}};

/// What takes the turned body to its position: the middle of the bottom of its bounding box goes there.
Vec3 translation_of(const SceneBody& body, const LoadedBody& loaded, const Mat3& rotation) {
  const Points turned = loaded.mesh.positions * rotation.transpose();
  const Vec3 low = turned.colwise().minCoeff();
  const Vec3 high = turned.colwise().maxCoeff();
  const Vec3 middle = (low + high) / 2;
  return body.position - Vec3(middle.x(), low.y(), middle.z());
}

/// Each position that triangles use, once: rows of the skin.
std::vector<int> contact_rows(const Skin& skin) {
  const std::vector<int> point_of = weld_points(skin.positions);
  std::set<int> used;
  for (const int vertex : std::span(skin.triangles.data(), static_cast<std::size_t>(skin.triangles.size()))) {
    used.insert(point_of[static_cast<std::size_t>(vertex)]);
  }
  return {used.begin(), used.end()};
}

bool is_inside(const Eigen::Array3d& fractions, const Box& box) {
  constexpr double kRounding = 1e-9;
  return (fractions >= box.min.array() - kRounding).all() && (fractions <= box.max.array() + kRounding).all();
}

/// Nodes (at rest, m) that lie in a box or within half a brick of it: where the bricks do not follow a face of the box,
/// the steps of what is held then lie as often before it as behind it. The lattice reaches a little beyond the body, so
/// nodes outside its bounding box count as on it.
std::vector<int> nodes_in(const Box& exact, const Points& nodes, const Vec3& extent, double brick_size) {
  const Eigen::Array3d margin = 0.49 * brick_size / extent.array();  // not quite half: a tie would be rounding's choice
  const Box box{.min = exact.min.array() - margin, .max = exact.max.array() + margin};
  std::vector<int> inside;
  for (int node = 0; node < nodes.rows(); ++node) {
    const Eigen::Array3d place = (nodes.row(node).transpose().array() / extent.array() + 0.5).max(0).min(1);
    if (is_inside(place, box)) inside.push_back(node);
  }
  return inside;
}

/// Every node that a pin holds at the start, once, with the axes of all its pins.
std::vector<HeldNode> held_nodes(const std::vector<PinnedNodes>& pinned, const std::vector<Pin>& pins) {
  std::map<int, HeldNode> held;
  for (const PinnedNodes& group : pinned) {
    if (pins[group.pin].from > 0) continue;
    for (const int node : group.nodes) {
      const auto [place, is_new] = held.try_emplace(node, HeldNode{.node = node, .axes = {false, false, false}});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (pins[group.pin].axes.held[axis]) place->second.axes[axis] = true;
      }
    }
  }
  std::vector<HeldNode> list;
  list.reserve(held.size());
  for (const auto& [node, entry] : held) list.push_back(entry);
  return list;
}

/// A brick's law depends on its Poisson's ratio in many constants, on its stiffness in one factor.
void check_region(const Material& region, const Material& body) {
  if (region.poisson == body.poisson) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("a region has the Poisson's ratio {}, its body {}: the materials of one body may differ in "
                          "stiffness and density only; give both the same ratio",
                          region.poisson, body.poisson));
}

/// Gives the bricks of the regions their stiffness and mass; where regions overlap the last one counts.
void apply_regions(const SceneBody& scene_body, const Vec3& extent, const Mat3& rest_from_bricks, Body& body) {
  const double corner_mass = body.material.density * body.grid.brick_volume() / 8;
  for (std::size_t brick = 0; brick < body.grid.cells.size(); ++brick) {
    const Vec3 cell = body.grid.cells[brick].cast<double>().array() + 0.5;
    const Vec3 middle = rest_from_bricks * (body.grid.origin + body.grid.brick_size * cell);
    const Region* found = nullptr;
    for (const Region& region : scene_body.regions) {
      if (is_inside(middle.array() / extent.array() + 0.5, region.box)) found = &region;
    }
    if (found == nullptr) continue;
    check_region(found->material, body.material);
    const double more_mass = (found->material.density / body.material.density - 1) * corner_mass;
    for (const int node : body.grid.nodes[brick]) body.masses[node] += more_mass * body.stiffness_scale[brick];
    body.stiffness_scale[brick] *= found->material.young / body.material.young;
  }
  if (!scene_body.regions.empty()) lay_tiles(body);
}

/// The bricks' volume may differ from the mesh's by this share before it is worth a warning.
constexpr double kVolumeError = 0.02;

double volume_error(const BrickGrid& grid, const Solid& solid) { return std::abs(grid.volume() / solid.volume - 1); }

/// Half of the brick size, or a quarter, ... : the first that holds the solid's volume; none down to a 64th.
std::optional<double> brick_size_for(const Solid& solid, double brick_size) {
  for (int halving = 0; halving < 6; ++halving) {
    brick_size /= 2;
    if (volume_error(voxelize(solid, brick_size), solid) <= kVolumeError) return brick_size;
  }
  return std::nullopt;
}

/// Adds the solids of one body.
class BodyBuilder {
 public:
  BodyBuilder(const Scene& scene, std::size_t index, const LoadedBody& loaded, Production& production)
      : body_(scene.bodies[index]),
        index_(index),
        loaded_(loaded),
        production_(production),
        rotation_(rotation_matrix(body_.rotation) * loaded.bricks_from_rest.transpose()),
        translation_(translation_of(body_, loaded, rotation_)) {}

  void add(const Solid& solid) {
    Actor actor;
    actor.body = make_body(make_grid(solid), body_.model, body_.material);
    apply_regions(body_, loaded_.extent, loaded_.bricks_from_rest.transpose(), actor.body);
    DrawnSkin drawn;
    drawn.skin = make_skin(submesh(loaded_.mesh, solid), {.max_edge = kLongestSkinEdge * loaded_.brick_size});
    drawn.embedding = embed(actor.body.grid, drawn.skin.positions, drawn.skin.normals);
    drawn.color = body_.color.value_or(kPalette[production_.skins.size() % kPalette.size()]);
    const std::vector<int> touching = contact_rows(drawn.skin);
    actor.contacts =
        embed(actor.body.grid, drawn.skin.positions(touching, Eigen::all), drawn.skin.normals(touching, Eigen::all));
    Origin origin{.body = index_, .bricks_from_rest = loaded_.bricks_from_rest, .pins = find_pins(actor.body)};
    actor.pinned = held_nodes(origin.pins, body_.pins);
    place(actor.body, rotation_, translation_);
    actor.body.velocities.rowwise() = body_.velocity.transpose();
    for (const HeldNode& held : actor.pinned) actor.body.velocities.row(held.node).setZero();
    outside_ += drawn.embedding.outside;
    furthest_outside_ = std::max(furthest_outside_, drawn.embedding.furthest);
    held_solids_ += origin.pins.empty() ? 0 : 1;
    production_.world.actors.push_back(std::move(actor));
    production_.origins.push_back(std::move(origin));
    production_.skins.push_back(std::move(drawn));
  }

  void report(const Console& console) const {
    if (outside_ > 0) {
      console.note(fmt::format("{}: {} outside every brick, {:.2g} bricks away at most, on the nearest one",
                               loaded_.name, count_of(outside_, "skin vertex rides", "skin vertices ride"),
                               furthest_outside_));
    }
    if (slivers_ > 0) {
      console.detail(
          fmt::format("{}: {} given to fuller neighbours", loaded_.name, count_of(slivers_, "nearly empty brick")));
    }
    report_pieces(console);
    if (wrong_volumes_ > 0) {
      const int more = wrong_volumes_ - 1;
      console.warn(fmt::format("{}: {}{}", loaded_.name, volume_warning_,
                               more > 0 ? fmt::format("; so are those of {} more", count_of(more, "solid")) : ""));
    }
    if (body_.pins.empty()) return;
    if (held_solids_ == 0) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: the pins hold no node; make their boxes at least a brick ({}) thick", loaded_.name,
                              readable(loaded_.brick_size, Dimension::kLength)));
    }
    const int free_solids = static_cast<int>(loaded_.solids.size()) - held_solids_;
    if (free_solids > 0) {
      console.warn(fmt::format("{}: {} of {} solids are not held by the pins and will fall", loaded_.name, free_solids,
                               loaded_.solids.size()));
    }
  }

 private:
  void report_pieces(const Console& console) const {
    if (pieces_.divided > 0) {
      console.detail(fmt::format("{}: {} more than one piece of solid, and a brick for each", loaded_.name,
                                 count_of(pieces_.divided, "cell holds", "cells hold")));
    }
    if (pieces_.dropped > 0) {
      console.warn(fmt::format("{}: dropped {} of floating specks, {:.2g} kg together", loaded_.name,
                               count_of(pieces_.dropped, "brick"), pieces_.dropped_volume * body_.material.density));
    }
    if (pieces_.floating > 0) {
      console.warn(fmt::format("{}: {} by parts too thin for bricks of {}; smaller bricks would hold them",
                               loaded_.name, count_of(pieces_.floating, "piece hangs", "pieces hang"),
                               readable(loaded_.brick_size, Dimension::kLength)));
    }
  }

  BrickGrid make_grid(const Solid& solid) {
    if (loaded_.grid) return *loaded_.grid;
    BrickGrid grid = voxelize(solid, loaded_.brick_size);
    add(split_pieces(solid, grid));
    slivers_ += absorb_slivers(grid);
    note_volume(grid, solid);
    return grid;
  }

  void add(const PieceReport& report) {
    pieces_.divided += report.divided;
    pieces_.dropped += report.dropped;
    pieces_.dropped_volume += report.dropped_volume;
    pieces_.floating += report.floating;
  }

  void note_volume(const BrickGrid& grid, const Solid& solid) {
    if (volume_error(grid, solid) <= kVolumeError) return;
    ++wrong_volumes_;
    if (wrong_volumes_ > 1) return;  // the largest solid comes first
    const double density = body_.material.density;
    const std::optional<double> better = brick_size_for(solid, loaded_.brick_size);
    volume_warning_ = fmt::format(
        "bricks of {} are too coarse: they hold {:.4g} kg where the mesh holds {:.4g} kg; {}",
        readable(loaded_.brick_size, Dimension::kLength), grid.volume() * density, solid.volume * density,
        better ? fmt::format("bricks of {} would do", readable(*better, Dimension::kLength)) : "use much smaller ones");
  }

  /// The body is still where its grid is.
  [[nodiscard]] std::vector<PinnedNodes> find_pins(const Body& body) const {
    const Points rest = body.rest_positions * loaded_.bricks_from_rest;
    std::vector<PinnedNodes> pinned;
    for (std::size_t pin = 0; pin < body_.pins.size(); ++pin) {
      const Box& box = body_.pins[pin].box;
      std::vector<int> nodes = nodes_in(box, rest, loaded_.extent, loaded_.brick_size);
      if (nodes.empty()) continue;
      const Eigen::Array3d middle = (box.min.array().max(0) + box.max.array().min(1)) / 2 - 0.5;
      const Vec3 centre = loaded_.bricks_from_rest * (middle * loaded_.extent.array()).matrix();
      pinned.push_back({.pin = pin, .nodes = std::move(nodes), .centre = rotation_ * centre + translation_});
    }
    return pinned;
  }

  const SceneBody& body_;
  std::size_t index_;
  const LoadedBody& loaded_;
  Production& production_;
  Mat3 rotation_;
  Vec3 translation_;
  int outside_ = 0;
  double furthest_outside_ = 0;  // bricks
  int slivers_ = 0;
  PieceReport pieces_;
  int wrong_volumes_ = 0;       // solids
  std::string volume_warning_;  // of the first of them
  int held_solids_ = 0;
};

/// A body may start a little too deep, and is then lifted gently; deeper it would be shot out of the ground.
/// Throws Error(kBadInput). Nodes that are held are not in the ground's way.
void check_ground(const Actor& actor, std::size_t index, const SceneBody& scene_body, double height) {
  std::vector<bool> is_held(static_cast<std::size_t>(actor.body.node_count()));
  for (const HeldNode& held : actor.pinned) is_held[static_cast<std::size_t>(held.node)] = true;
  const Points points = deform_points(actor.body.grid, actor.contacts, actor.body.positions);
  double lowest = height;
  for (int point = 0; point < points.rows(); ++point) {
    const auto& nodes =
        actor.body.grid.nodes[static_cast<std::size_t>(actor.contacts.brick[static_cast<std::size_t>(point)])];
    const bool is_free =
        std::any_of(nodes.begin(), nodes.end(), [&](int node) { return !is_held[static_cast<std::size_t>(node)]; });
    if (is_free) lowest = std::min(lowest, points(point, 1));
  }
  const double depth = height - lowest;
  if (depth <= actor.body.grid.brick_size) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("body {} starts {} below the ground (y = {:.6g} m); a body may overlap it by one brick ({}) at "
                  "most: raise its position from y = {:.6g} m to {:.6g} m or lower the ground",
                  index + 1, readable(depth, Dimension::kLength), height,
                  readable(actor.body.grid.brick_size, Dimension::kLength), scene_body.position.y(),
                  std::abs(scene_body.position.y() + depth) < 1e-9 * depth ? 0 : scene_body.position.y() + depth));
}

}  // namespace

Production build_world(const Scene& scene, const std::vector<LoadedBody>& bodies, const Console& console) {
  Production production;
  production.world.gravity = scene.gravity;
  if (!scene.obstacles.empty()) {
    const Obstacle& ground = scene.obstacles.front();
    production.world.ground =
        Ground{.height = ground.plane.y, .friction = ground.friction, .restitution = ground.restitution};
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    BodyBuilder builder(scene, i, bodies[i], production);
    for (const Solid& solid : bodies[i].solids) builder.add(solid);
    builder.report(console);
    production.size = std::max(production.size, bodies[i].extent.maxCoeff());
  }
  if (!is_motion(scene) || !production.world.ground) return production;
  for (std::size_t i = 0; i < production.world.actors.size(); ++i) {
    const std::size_t body = production.origins[i].body;
    brace(production.world.actors[i].body, scene.gravity.norm(), production.world.ground->height);
    check_ground(production.world.actors[i], body, scene.bodies[body], production.world.ground->height);
  }
  return production;
}

Points skin_positions(const Production& production, std::size_t actor, const Points& nodes) {
  return deform_points(production.world.actors[actor].body.grid, production.skins[actor].embedding, nodes);
}

}  // namespace sprung
