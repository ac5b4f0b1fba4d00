#include "app/body_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "app/placed_loads.h"
#include "app/regions.h"
#include "app/units.h"
#include "core/bricks/pieces.h"
#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/soft_body.h"

namespace sprung {
namespace {

/// For bodies whose scene names no colour; the solids of a file differ.
constexpr std::array<Color, 8> kPalette{{{0xd8, 0x32, 0x2a},
                                         {0xf2, 0xa0, 0x3d},
                                         {0x3b, 0x8e, 0xa5},
                                         {0x6a, 0x9f, 0x4e},
                                         {0x8a, 0x5a, 0xa8},
                                         {0xe8, 0xc5, 0x47},
                                         {0xc7, 0x6b, 0x8f},
                                         {0x4f, 0x6d, 0xb8}}};

/// Which solid each vertex of a mesh belongs to; the first, where none has it.
std::vector<int> solids_of_vertices(const LoadedBody& loaded) {
  std::vector<int> owners(loaded.mesh.positions.rows(), -1);
  for (std::size_t solid = 0; solid < loaded.solids.size(); ++solid) {
    for (const int triangle : loaded.solids[solid].source) {
      if (triangle < 0) continue;
      for (const int vertex : loaded.mesh.triangles.row(triangle)) {
        int& owner = owners[vertex];
        if (owner < 0) owner = int(solid);
      }
    }
  }
  std::replace(owners.begin(), owners.end(), -1, 0);
  return owners;
}

/// Sums of the normals of a solid's triangles at the vertices of its mesh, n x 3.
Points outward_of(const SurfaceMesh& mesh, const Solid& solid) {
  Points sums = Points::Zero(mesh.positions.rows(), 3);
  for (std::size_t t = 0; t < solid.source.size(); ++t) {
    if (solid.source[t] < 0) continue;
    const auto corners = mesh.triangles.row(solid.source[t]);
    const Eigen::RowVector3d a = mesh.positions.row(corners[0]);
    const Eigen::RowVector3d b = mesh.positions.row(corners[1]);
    const Eigen::RowVector3d normal = (b - a).cross(mesh.positions.row(corners[2]) - a) * (solid.flipped[t] ? -1 : 1);
    for (const int vertex : corners) sums.row(vertex) += normal;
  }
  return sums;
}

CarriedVertices carry(const LoadedBody& loaded, std::size_t solid, const std::vector<int>& owners,
                      const BrickGrid& grid) {
  CarriedVertices carried;
  for (std::size_t vertex = 0; vertex < owners.size(); ++vertex) {
    if (owners[vertex] == int(solid)) carried.vertices.push_back(int(vertex));
  }
  const Points outward = outward_of(loaded.mesh, loaded.solids[solid]);
  carried.embedding =
      embed(grid, loaded.mesh.positions(carried.vertices, Eigen::all), outward(carried.vertices, Eigen::all));
  return carried;
}

/// Every node that a pin holds at the start, once, with the axes of all its pins.
std::vector<KinematicNode> held_nodes(const std::vector<PinnedNodes>& pinned, const std::vector<Pin>& pins) {
  std::map<int, KinematicNode> held;
  for (const PinnedNodes& group : pinned) {
    if (pins[group.pin].from > 0) continue;
    for (const int node : group.nodes) {
      const auto [place, is_new] = held.try_emplace(node, KinematicNode{.node = node, .axes = {false, false, false}});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (pins[group.pin].axes.held[axis]) place->second.axes[axis] = true;
      }
    }
  }
  std::vector<KinematicNode> list;
  list.reserve(held.size());
  for (const auto& [node, entry] : held) list.push_back(entry);
  return list;
}

/// m/s, at the start; what is held is at rest.
Points velocities_of(const SceneBody& scene_body, const Actor& actor, const Vec3& middle) {
  Points velocities(actor.body.node_count(), 3);
  const Vec3 spin = scene_body.spin * std::numbers::pi / 180;
  for (int node = 0; node < velocities.rows(); ++node) {
    const Vec3 arm = actor.body.positions.row(node).transpose() - middle;
    velocities.row(node) = (scene_body.velocity + spin.cross(arm)).transpose();
  }
  for (const KinematicNode& held : actor.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (held.axes[axis]) velocities(held.node, axis) = 0;
    }
  }
  return velocities;
}

}  // namespace

BodyBuilder::BodyBuilder(const Scene& scene, std::size_t index, const LoadedBody& loaded, Production& production)
    : body_(scene.bodies[index]),
      index_(index),
      loaded_(loaded),
      production_(production),
      touches_itself_(scene.contact.self),
      selector_(loaded),
      report_(loaded, body_.material.density),
      solid_of_vertex_(solids_of_vertices(loaded)) {}

void BodyBuilder::fill_solids() {
  for (std::size_t solid = 0; solid < loaded_.solids.size(); ++solid) filled_.push_back(fill(solid));
}

void BodyBuilder::add_solids() {
  const std::vector<Pose> poses = poses_of(body_, loaded_);
  for (const Filled& filled : filled_) {
    for (std::size_t copy = 0; copy < poses.size(); ++copy) put(filled, poses[copy], int(copy));
  }
  const SurfaceMesh& mesh = loaded_.mesh;
  production_.meshes.push_back({.positions = mesh.positions,
                                .normals = mesh.normals.cast<double>(),
                                .uvs = mesh.uvs,
                                .colors = mesh.colors,
                                .triangles = mesh.triangles,
                                .parts = mesh.parts,
                                .materials = mesh.materials});
}

BodyBuilder::Filled BodyBuilder::fill(std::size_t solid) {
  const Solid& outline = loaded_.solids[solid];
  SoftBody made = make_soft_body(loaded_.mesh, outline, make_grid(outline), body_.model, body_.material);
  Filled filled;
  filled.actor = std::move(made.actor);
  filled.drawn.skin = std::move(made.skin);
  filled.drawn.embedding = std::move(made.embedding);
  Body& body = filled.actor.body;
  filled.regions = apply_regions(body_.regions, selector_, body, solid);
  report_.add(filled.drawn.embedding);
  filled.carried = carry(loaded_, solid, solid_of_vertex_, body.grid);
  filled.actor.friction = body_.friction;
  filled.actor.collides_with_itself = filled.actor.collides_with_itself && touches_itself_;
  filled.pins = find_pins(body, solid);
  held_solids_ += filled.pins.empty() ? 0 : 1;
  filled.actor.pinned = held_nodes(filled.pins, body_.pins);
  filled.forces = place_forces(body_.forces, selector_, filled.actor, solid);
  filled.muscles = place_muscles(body_.muscles, selector_, filled.actor, solid, loaded_.bricks_from_rest);
  return filled;
}

void BodyBuilder::put(Filled filled, const Pose& pose, int copy) {
  place(filled.actor.body, pose.rotation, pose.translation);
  filled.actor.body.velocities = velocities_of(body_, filled.actor, pose.translation);
  for (PinnedNodes& pinned : filled.pins) pinned.centre = pose.rotation * pinned.centre + pose.translation;
  filled.drawn.color = body_.color.value_or(kPalette[production_.skins.size() % kPalette.size()]);
  production_.world.actors.push_back(std::move(filled.actor));
  production_.origins.push_back({.body = index_,
                                 .copy = copy,
                                 .bricks_from_rest = loaded_.bricks_from_rest,
                                 .regions = std::move(filled.regions),
                                 .pins = std::move(filled.pins),
                                 .forces = std::move(filled.forces),
                                 .muscles = std::move(filled.muscles)});
  production_.skins.push_back(std::move(filled.drawn));
  production_.carried.push_back(std::move(filled.carried));
}

BrickGrid BodyBuilder::make_grid(const Solid& solid) {
  if (loaded_.grid) return *loaded_.grid;
  BrickGrid grid = voxelize(solid, loaded_.brick_size);
  const PieceReport pieces = split_pieces(solid, grid);
  report_.add(pieces, absorb_slivers(grid));
  report_.add_volume(grid, solid);
  return grid;
}

std::vector<PinnedNodes> BodyBuilder::find_pins(const Body& body, std::size_t solid) const {
  std::vector<PinnedNodes> pinned;
  for (std::size_t pin = 0; pin < body_.pins.size(); ++pin) {
    std::vector<int> nodes = selector_.nodes(body_.pins[pin], body.rest_positions, solid);
    if (nodes.empty()) continue;
    pinned.push_back({.pin = pin, .nodes = std::move(nodes), .centre = selector_.centre(body_.pins[pin])});
  }
  return pinned;
}

void BodyBuilder::tell(const Console& console) const {
  report_.tell(console);
  if (body_.pins.empty()) return;
  if (held_solids_ == 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the pins hold no node; make what they choose at least a brick ({}) thick",
                            loaded_.name, readable(loaded_.brick_size, Dimension::kLength)));
  }
  const int free_solids = isize(loaded_.solids) - held_solids_;
  if (free_solids == 0) return;
  console.warn(fmt::format("{}: {} of {} solids are not held by the pins and will fall", loaded_.name, free_solids,
                           loaded_.solids.size()));
}

}  // namespace sprung
