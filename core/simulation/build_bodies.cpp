#include "core/simulation/build_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <span>

#include "core/body/brick_model.h"
#include "core/bricks/fill_solid.h"
#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/mesh/repair/coarsen.h"
#include "core/mesh/repair/submesh.h"
#include "core/mesh/repair/weld.h"
#include "core/simulation/body_loads.h"
#include "core/simulation/selector.h"
#include "core/simulation/simulation.h"
#include "core/simulation/skin_supports.h"
#include "core/skin/skin.h"
#include "core/text.h"
#include "core/types.h"
#include "core/units.h"

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
void carry_file_vertices(const LoadedBody& loaded, std::size_t solid, const std::vector<int>& owners, SoftBody& body) {
  for (std::size_t vertex = 0; vertex < owners.size(); ++vertex) {
    if (owners[vertex] == int(solid)) body.file_vertices.push_back(int(vertex));
  }
  const Points outward = outward_of(loaded.mesh, loaded.solids[solid]);
  body.file_embedding =
      embed(body.grid, loaded.mesh.positions(body.file_vertices, Eigen::all), outward(body.file_vertices, Eigen::all));
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
  body.contacts = embed(body.grid, surface.points, outward_at(surface.points, surface.triangles));
  body.contact_triangles = surface.triangles;
}

}  // namespace

SoftBody make_soft_body(const SurfaceMesh& mesh, const Solid& solid, BrickGrid grid, Model model,
                        const Material& material, bool can_touch) {
  SoftBody body(make_body(std::move(grid), model, material));
  body.surface = std::make_shared<const SurfaceMesh>(submesh(mesh, solid));
  body.skin = make_skin(*body.surface, {.max_edge = kLongestSkinEdge * body.grid.brick_size});
  body.skin_embedding = embed(body.grid, body.skin.positions, body.skin.normals);
  if (can_touch) add_contacts(body.skin, body);
  body.collides_with_itself = solid.closed && !solid.overlaps && solid.thickness == 0;
  return body;
}

EmbeddedSkin smooth_skin(const SoftBody& body, double tolerance) {
  const std::vector<Eigen::Vector3i>& cells = body.grid.cells;
  const bool has_several_in_cell = std::adjacent_find(cells.begin(), cells.end()) != cells.end();
  const bool can_embed = !body.grid.patches.empty() || !has_several_in_cell;  // caches have no patches
  if (body.surface == nullptr || !can_embed) return {body.skin, body.skin_embedding};
  EmbeddedSkin smooth{.skin = make_skin(*body.surface, {.is_smooth = true}), .embedding = {}};
  refine_curves(smooth.skin, tolerance);
  refine(smooth.skin, kLongestSkinEdge * body.grid.brick_size);
  smooth.embedding = embed(body.grid, smooth.skin.positions, smooth.skin.normals);
  return smooth;
}

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
    const auto has_bricks = [&, solid = std::size_t{0}](const SoftBody& body) mutable {
      return !selector_.bricks(body_.regions[row], body.grid, solid++).empty();
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
  for (const SoftBody& body : filled_) {
    for (std::size_t copy = 0; copy < poses.size(); ++copy) put(body, poses[copy], int(copy));
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

SoftBody BodyBuilder::fill(std::size_t solid) {
  const Solid& outline = loaded_.solids[solid];
  SoftBody body = make_soft_body(loaded_.mesh, outline, make_grid(outline), body_.model, body_.material, can_touch_);
  body.friction = body_.friction;
  body.collides_with_itself = body.collides_with_itself && collides_with_itself_;
  report_.add(body.skin_embedding);
  carry_file_vertices(loaded_, solid, solid_of_vertex_, body);
  Origin& origin = body.origin;
  origin.body = index_;
  origin.bricks_from_rest = loaded_.bricks_from_rest;
  origin.regions = apply_regions(body_.regions, selector_, body, solid);
  origin.pins = find_pins(body, solid);
  origin.pinned_skins = find_pinned_skins(body_.pins, selector_, body, solid);
  origin.forces = place_forces(body_.forces, selector_, body, solid);
  origin.muscles = place_muscles(body_.muscles, selector_, body, solid, loaded_.bricks_from_rest);
  origin.probed = find_probed(body, solid);
  body.pinned = kinematic_nodes(origin.pins, body_.pins);
  pinned_solids_ += origin.pins.empty() && origin.pinned_skins.empty() ? 0 : 1;
  return body;
}

void BodyBuilder::put(SoftBody body, const Pose& pose, int copy) {
  place(body, pose.rotation, pose.translation);
  body.velocities = velocities_of(body_, body, pose.translation);
  for (ForcedPart& part : body.origin.forces) sprung::place(part, pose.rotation, pose.translation);
  const auto move_centre = [&](auto& pinned) { pinned.centre = pose.rotation * pinned.centre + pose.translation; };
  std::for_each(body.origin.pins.begin(), body.origin.pins.end(), move_centre);
  std::for_each(body.origin.pinned_skins.begin(), body.origin.pinned_skins.end(), move_centre);
  body.color = body_.color.value_or(kPalette[simulation_.world.bodies.size() % kPalette.size()]);
  body.origin.copy = copy;
  simulation_.world.bodies.push_back(std::move(body));
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
    for (std::size_t point = 0; point < body.skin_embedding.brick.size(); ++point) {
      if (is_in_part[body.skin_embedding.brick[point]]) part.skin_points.push_back(int(point));
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
    const auto holds = [&](const SoftBody& solid) {
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

namespace {

/// Random numbers that are equal on all platforms, unlike those of the standard's distributions.
class Chance {
 public:
  explicit Chance(int seed) : engine_(static_cast<std::uint64_t>(seed)) {}

  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * std::ldexp(engine_() >> 11U, -53); }
  Vec3 in_cube(double reach) {
    const double x = between(-reach, reach);
    const double y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
  }
  Vec3 direction() {
    const double height = between(-1, 1);
    const double angle = between(0, 2 * std::numbers::pi);
    const double radius = std::sqrt(1 - height * height);
    return {radius * std::cos(angle), radius * std::sin(angle), height};
  }

 private:
  std::mt19937_64 engine_;
};

/// Moves the bottom centre of the rotated body's bounding box to `position`.
Pose pose_at(const Vec3& position, const Mat3& rotation, const LoadedBody& loaded) {
  const Points flipped = loaded.mesh.positions * rotation.transpose();
  const Vec3 low = flipped.colwise().minCoeff();
  const Vec3 high = flipped.colwise().maxCoeff();
  const Vec3 middle = (low + high) / 2;
  return {.rotation = rotation, .translation = position - Vec3(middle.x(), low.y(), middle.z())};
}

}  // namespace

std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded) {
  const Mat3 rotation = rotation_matrix(body.rotation) * loaded.bricks_from_rest.transpose();
  if (!body.copies) return {pose_at(body.position, rotation, loaded)};
  const Copies& copies = *body.copies;
  Chance chance(copies.seed);
  std::vector<Pose> poses;
  for (int k = 0; k < copies.count[2]; ++k) {
    for (int j = 0; j < copies.count[1]; ++j) {
      for (int i = 0; i < copies.count[0]; ++i) {
        const Vec3 position =
            body.position + Vec3(i, j, k).cwiseProduct(copies.spacing) + chance.in_cube(copies.scatter);
        const double turn = chance.between(0, copies.turn) * std::numbers::pi / 180;
        const Vec3 axis = chance.direction();
        poses.push_back(pose_at(position, Eigen::AngleAxisd(turn, axis) * rotation, loaded));
      }
    }
  }
  return poses;
}

namespace {

/// The relative error of the bricks' volume from which on there is a warning.
constexpr double kVolumeError = 0.02;
constexpr double kFarOutside = 0.1;   // bricks
constexpr double kResolvedShell = 2;  // bricks: thicker shells are resolved

double volume_error(const BrickGrid& grid, const Solid& solid) { return std::abs(grid.volume() / solid.volume - 1); }

/// The first of half of the brick size, a quarter, ... that represents the solid's volume; none down to a 64th.
std::optional<double> brick_size_for(const Solid& solid, double brick_size) {
  for (int halving = 0; halving < 6; ++halving) {
    brick_size /= 2;
    if (volume_error(voxelize(solid, brick_size), solid) <= kVolumeError) return brick_size;
  }
  return std::nullopt;
}

}  // namespace

void FillReport::add(const PieceReport& pieces, int slivers) {
  pieces_.divided += pieces.divided;
  pieces_.dropped += pieces.dropped;
  pieces_.dropped_volume += pieces.dropped_volume;
  pieces_.floating += pieces.floating;
  slivers_ += slivers;
}

void FillReport::add(const Embedding& skin) {
  outside_ += skin.outside;
  furthest_outside_ = std::max(furthest_outside_, skin.furthest);
}

void FillReport::add_volume(const BrickGrid& grid, const Solid& solid) {
  // For thick shells the bricks are more accurate: area times thickness counts overlaps twice.
  if (solid.thickness > kResolvedShell * body_.brick_size) return;
  if (volume_error(grid, solid) <= kVolumeError) return;
  ++wrong_volumes_;
  if (wrong_volumes_ > 1) return;
  const std::optional<double> better = brick_size_for(solid, body_.brick_size);
  volume_warning_ =
      fmt::format("bricks of {} are too coarse: they hold {:.4g} kg, the mesh {:.4g} kg; {}",
                  readable(body_.brick_size, Dimension::kLength), grid.volume() * density_, solid.volume * density_,
                  better ? fmt::format("bricks of {} would suffice for the mass", readable(*better, Dimension::kLength))
                         : "use much smaller ones");
}

void FillReport::tell(const Observer& observer) const {
  if (furthest_outside_ > kFarOutside) {
    observer.note(
        fmt::format("{}: {} in no brick, up to {:.2g} bricks from the nearest, and {} what that does; more "
                    "bricks hold them better",
                    body_.name, count_of(outside_, "skin vertex is", "skin vertices are"), furthest_outside_,
                    outside_ == 1 ? "continues" : "continue"));
  }
  if (slivers_ > 0) {
    observer.detail(
        fmt::format("{}: {} merged into fuller neighbours", body_.name, count_of(slivers_, "nearly empty brick")));
  }
  tell_pieces(observer);
  if (wrong_volumes_ == 0) return;
  const int more = wrong_volumes_ - 1;
  observer.warn(fmt::format("{}: {}{}", body_.name, volume_warning_,
                            more > 0 ? fmt::format("; so are those of {} more", count_of(more, "solid")) : ""));
}

void FillReport::tell_pieces(const Observer& observer) const {
  if (pieces_.divided > 0) {
    observer.detail(fmt::format("{}: {} several pieces of solid, each in a brick of its own", body_.name,
                                count_of(pieces_.divided, "cell contains", "cells contain")));
  }
  if (pieces_.dropped > 0) {
    observer.warn(fmt::format("{}: dropped {} of floating specks, {:.2g} kg together", body_.name,
                              count_of(pieces_.dropped, "brick"), pieces_.dropped_volume * density_));
  }
  if (pieces_.floating > 0) {
    observer.warn(fmt::format("{}: {} connected by parts too thin for bricks of {}; use smaller bricks", body_.name,
                              count_of(pieces_.floating, "piece is", "pieces are"),
                              readable(body_.brick_size, Dimension::kLength)));
  }
}

}  // namespace sprung
