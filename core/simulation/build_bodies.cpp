#include "core/simulation/build_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <numeric>

#include "core/body/brick_model.h"
#include "core/bricks/fill_solid.h"
#include "core/error.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/body_poses.h"
#include "core/simulation/selector.h"
#include "core/simulation/simulation.h"
#include "core/simulation/skin_supports.h"
#include "core/skin/skin.h"
#include "core/text.h"
#include "core/types.h"
#include "core/units.h"
#include "core/world/make_soft_body.h"

namespace sprung {
namespace {

/// For bodies without a colour in the scene, a different one for each solid of a file: calm, and consecutive ones are
/// far apart in hue.
constexpr std::array<Color, 8> kPalette{{{0x5e, 0x9c, 0xa0},
                                         {0xe0, 0xa4, 0x58},
                                         {0x7c, 0x8f, 0xc4},
                                         {0x8f, 0xb0, 0x6b},
                                         {0xc9, 0x72, 0x7a},
                                         {0x5b, 0x7f, 0xa6},
                                         {0xe3, 0xc8, 0x78},
                                         {0xb5, 0x8b, 0xb8}}};

/// The solid of each vertex of a mesh; the first, if it belongs to none.
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

/// The vertices of the file's mesh that are embedded in a solid.
void carry_file_vertices(const LoadedBody& loaded, std::size_t solid, const std::vector<int>& owners,
                         const BrickGrid& grid, Origin& origin) {
  for (std::size_t vertex = 0; vertex < owners.size(); ++vertex) {
    if (owners[vertex] == int(solid)) origin.file_vertices.push_back(int(vertex));
  }
  const Points outward = outward_of(loaded.mesh, loaded.solids[solid]);
  origin.file_embedding =
      embed(grid, loaded.mesh.positions(origin.file_vertices, Eigen::all), outward(origin.file_vertices, Eigen::all));
}

/// Every node pinned at the start, once, with the axes of all its pins.
std::vector<KinematicNode> kinematic_nodes(const std::vector<PinnedNodes>& groups, const std::vector<Pin>& pins) {
  std::map<int, KinematicNode> pinned;
  for (const PinnedNodes& group : groups) {
    if (pins[group.pin].from > 0) continue;
    for (const int node : group.nodes) {
      const auto [entry, is_new] = pinned.try_emplace(node, KinematicNode{.node = node, .axes = {false, false, false}});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (pins[group.pin].axes.fixed[axis]) entry->second.axes[axis] = true;
      }
    }
  }
  std::vector<KinematicNode> list;
  list.reserve(pinned.size());
  for (const auto& [node, entry] : pinned) list.push_back(entry);
  return list;
}

/// m/s, at the start; pinned nodes are at rest.
Points velocities_of(const SceneBody& scene_body, const SoftBody& body, const Vec3& middle) {
  Points velocities(body.node_count(), 3);
  const Vec3 spin = scene_body.spin * std::numbers::pi / 180;
  for (int node = 0; node < velocities.rows(); ++node) {
    const Vec3 arm = body.positions.row(node).transpose() - middle;
    velocities.row(node) = (scene_body.velocity + spin.cross(arm)).transpose();
  }
  for (const KinematicNode& pinned : body.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (pinned.axes[axis]) velocities(pinned.node, axis) = 0;
    }
  }
  return velocities;
}

}  // namespace

BodyBuilder::BodyBuilder(const Scene& scene, std::size_t index, const LoadedBody& loaded, Simulation& simulation)
    : scene_(scene),
      body_(scene.bodies[index]),
      index_(index),
      loaded_(loaded),
      simulation_(simulation),
      can_touch_(is_motion(scene)),
      collides_with_itself_(scene.contact.self),
      selector_(loaded),
      report_(loaded, body_.material.density),
      solid_of_vertex_(solids_of_vertices(loaded)) {}

void BodyBuilder::fill_solids() {
  for (std::size_t solid = 0; solid < loaded_.solids.size(); ++solid) filled_.push_back(fill(solid));
  check_regions();
}

void BodyBuilder::check_regions() const {
  for (std::size_t row = 0; row < body_.regions.size(); ++row) {
    const auto has_bricks = [&, solid = std::size_t{0}](const FilledBody& filled) mutable {
      return !selector_.bricks(body_.regions[row], filled.body.grid, solid++).empty();
    };
    if (std::any_of(filled_.begin(), filled_.end(), has_bricks)) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("body {}: its region {} holds the middle of no brick; make the part it selects at least a "
                            "brick large",
                            index_ + 1, row + 1));
  }
}

void BodyBuilder::add_solids() {
  const std::vector<Pose> poses = poses_of(body_, loaded_);
  for (const FilledBody& filled : filled_) {
    for (std::size_t copy = 0; copy < poses.size(); ++copy) put(filled, poses[copy], int(copy));
  }
  const SurfaceMesh& mesh = loaded_.mesh;
  simulation_.meshes.push_back({.positions = mesh.positions,
                                .normals = mesh.normals.cast<double>(),
                                .uvs = mesh.uvs,
                                .colors = mesh.colors,
                                .triangles = mesh.triangles,
                                .parts = mesh.parts,
                                .materials = mesh.materials});
}

BodyBuilder::FilledBody BodyBuilder::fill(std::size_t solid) {
  const Solid& outline = loaded_.solids[solid];
  SoftBody body = make_soft_body(loaded_.mesh, outline, make_grid(outline), body_.model,
                                 simulated_material(scene_, body_), can_touch_);
  body.contact.friction = body_.friction;
  body.contact.with_itself = body.contact.with_itself && collides_with_itself_;
  report_.add(body.drawn.embedding);
  Origin origin;
  origin.body = index_;
  carry_file_vertices(loaded_, solid, solid_of_vertex_, body.grid, origin);
  origin.bricks_from_rest = loaded_.bricks_from_rest;
  origin.regions = apply_regions(body_, selector_, body, solid);
  origin.pins = find_pins(body, solid);
  origin.pinned_skins = find_pinned_skins(body_.pins, selector_, body, solid);
  origin.forces = place_forces(body_.forces, selector_, body, solid);
  origin.muscles = place_muscles(body_.muscles, selector_, body, solid, loaded_.bricks_from_rest);
  origin.probed = find_probed(body, solid);
  body.pinned = kinematic_nodes(origin.pins, body_.pins);
  pinned_solids_ += origin.pins.empty() && origin.pinned_skins.empty() ? 0 : 1;
  return {std::move(body), std::move(origin)};
}

void BodyBuilder::put(FilledBody filled, const Pose& pose, int copy) {
  auto& [body, origin] = filled;
  place(body, pose.rotation, pose.translation);
  body.velocities = velocities_of(body_, body, pose.translation);
  for (ForcedPart& part : origin.forces) sprung::place(part, pose.rotation, pose.translation);
  const auto move_centre = [&](auto& pinned) { pinned.centre = pose.rotation * pinned.centre + pose.translation; };
  std::for_each(origin.pins.begin(), origin.pins.end(), move_centre);
  std::for_each(origin.pinned_skins.begin(), origin.pinned_skins.end(), move_centre);
  set_foundations(scene_, origin, 0, false, body);
  body.drawn.color = body_.color.value_or(kPalette[simulation_.world.bodies.size() % kPalette.size()]);
  origin.copy = copy;
  simulation_.world.bodies.push_back(std::move(body));
  simulation_.origins.push_back(std::move(origin));
}

BrickGrid BodyBuilder::make_grid(const Solid& solid) {
  if (loaded_.grid) return *loaded_.grid;
  FilledSolid filled = fill_solid(solid, loaded_.brick_size, bricks_for(body_.model));
  report_.add(filled.pieces, filled.slivers);
  report_.add_volume(filled.grid, solid);
  return std::move(filled.grid);
}

std::vector<PinnedNodes> BodyBuilder::find_pins(const Body& body, std::size_t solid) const {
  std::vector<PinnedNodes> pinned;
  for (std::size_t pin = 0; pin < body_.pins.size(); ++pin) {
    if (body_.pins[pin].on_surface) continue;
    std::vector<int> nodes = selector_.nodes(body_.pins[pin], body.rest_positions, solid);
    if (nodes.empty()) continue;
    pinned.push_back({.pin = pin, .nodes = std::move(nodes), .centre = selector_.centre(body_.pins[pin])});
  }
  return pinned;
}

std::vector<ProbedPart> BodyBuilder::find_probed(const SoftBody& body, std::size_t solid) const {
  std::vector<ProbedPart> parts;
  for (std::size_t row = 0; row < scene_.probes.size(); ++row) {
    const Probe& probe = scene_.probes[row];
    if (std::size_t(probe.body - 1) != index_ || probe.kind() != ProbeKind::kPart) continue;
    ProbedPart part{.probe = row, .bricks = {}, .skin_points = {}};
    if (is_whole(probe.selection)) {
      part.bricks.resize(body.grid.cells.size());
      std::iota(part.bricks.begin(), part.bricks.end(), 0);
    } else {
      part.bricks = selector_.touched_bricks(probe.selection, body.grid, solid);
    }
    if (part.bricks.empty()) continue;
    std::vector<bool> is_in_part(body.grid.cells.size(), false);
    for (const int brick : part.bricks) is_in_part[brick] = true;
    for (std::size_t point = 0; point < body.drawn.embedding.brick.size(); ++point) {
      if (is_in_part[body.drawn.embedding.brick[point]]) part.skin_points.push_back(int(point));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

namespace {

/// "pin 'left'" or "pin 2"; "the pin" if there is only one.
std::string pin_name(const std::vector<Pin>& pins, std::size_t pin) {
  if (!pins[pin].name.empty()) return fmt::format("pin '{}'", pins[pin].name);
  return pins.size() == 1 ? "the pin" : fmt::format("pin {}", pin + 1);
}

std::string remedy_for_pin(const Pin& pin, const LoadedBody& loaded) {
  const std::string brick = readable(loaded.brick_size, Dimension::kLength);
  if (!pin.box) return fmt::format("make the part that it selects at least a brick ({}) thick", brick);
  const Vec3& low = pin.box->min;
  const Vec3& high = pin.box->max;
  const auto length = [](double value) { return readable(value, Dimension::kLength); };
  const Vec3& extent = loaded.extent;
  return fmt::format(
      "its box reaches from [{:g}, {:g}, {:g}] to [{:g}, {:g}, {:g}] of the body's, which is {} x {} x {} "
      "and goes from [0, 0, 0] to [1, 1, 1]; make it reach the body, at least a brick ({}) thick",
      low.x(), low.y(), low.z(), high.x(), high.y(), high.z(), length(extent.x()), length(extent.y()),
      length(extent.z()), brick);
}

}  // namespace

void BodyBuilder::tell(const Observer& observer) const {
  report_.tell(observer);
  if (body_.pins.empty()) return;
  for (std::size_t pin = 0; pin < body_.pins.size(); ++pin) {
    const auto holds = [&](const FilledBody& solid) {
      const auto is_of_pin = [&](const auto& pinned) { return pinned.pin == pin; };
      const Origin& origin = solid.origin;
      return std::any_of(origin.pins.begin(), origin.pins.end(), is_of_pin) ||
             std::any_of(origin.pinned_skins.begin(), origin.pinned_skins.end(), is_of_pin);
    };
    if (std::any_of(filled_.begin(), filled_.end(), holds)) continue;
    const std::string reason = fmt::format("{}: {} holds no node; {}", loaded_.name, pin_name(body_.pins, pin),
                                           remedy_for_pin(body_.pins[pin], loaded_));
    if (pinned_solids_ == 0) throw Error(ErrorKind::kBadInput, reason);
    observer.warn(reason);
  }
  const int free_solids = isize(loaded_.solids) - pinned_solids_;
  if (free_solids == 0) return;
  observer.warn(fmt::format("{}: {} of {} solids are not held by the pins and will fall", loaded_.name, free_solids,
                            loaded_.solids.size()));
}

}  // namespace sprung
