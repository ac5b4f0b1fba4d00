#include "app/build_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "app/units.h"
#include "core/bricks/slivers.h"
#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/skin/corner_normals.h"

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

Mat3 rotation_matrix(const Vec3& degrees) {
  const Vec3 angles = degrees * std::numbers::pi / 180;
  const Eigen::AngleAxisd about_x(angles.x(), Vec3::UnitX());
  const Eigen::AngleAxisd about_y(angles.y(), Vec3::UnitY());
  const Eigen::AngleAxisd about_z(angles.z(), Vec3::UnitZ());
  return (about_z * about_y * about_x).toRotationMatrix();
}

/// What takes the turned body to its position: the middle of the bottom of its bounding box goes there.
Vec3 translation_of(const SceneBody& body, const LoadedBody& loaded, const Mat3& rotation) {
  const Points turned = loaded.mesh.positions * rotation.transpose();
  const Vec3 low = turned.colwise().minCoeff();
  const Vec3 high = turned.colwise().maxCoeff();
  const Vec3 middle = (low + high) / 2;
  return body.position - Vec3(middle.x(), low.y(), middle.z());
}

/// Each position that triangles use, once.
Points contact_points(const Skin& skin) {
  const std::vector<int> point_of = weld_points(skin.positions);
  std::set<int> used;
  for (const int vertex : std::span(skin.triangles.data(), static_cast<std::size_t>(skin.triangles.size()))) {
    used.insert(point_of[static_cast<std::size_t>(vertex)]);
  }
  const std::vector<int> rows(used.begin(), used.end());
  return skin.positions(rows, Eigen::all);
}

/// Nodes of a grid in the rest frame that lie in one of the boxes. The lattice reaches a little beyond the body, so
/// nodes outside its bounding box count as on it.
std::vector<int> pinned_nodes(const Points& nodes, const std::vector<Pin>& pins, const Vec3& extent) {
  std::vector<int> pinned;
  for (int node = 0; node < nodes.rows(); ++node) {
    const Eigen::Array3d place = (nodes.row(node).transpose().array() / extent.array() + 0.5).max(0).min(1);
    const auto holds = [&](const Pin& pin) {
      return (place >= pin.box.min.array()).all() && (place <= pin.box.max.array()).all();
    };
    if (std::any_of(pins.begin(), pins.end(), holds)) pinned.push_back(node);
  }
  return pinned;
}

/// Adds the solids of one body.
class BodyBuilder {
 public:
  BodyBuilder(const SceneBody& body, const LoadedBody& loaded, Production& production)
      : body_(body),
        loaded_(loaded),
        production_(production),
        rotation_(rotation_matrix(body.rotation)),
        translation_(translation_of(body, loaded, rotation_)) {}

  void add(const Solid& solid) {
    BrickGrid grid = voxelize(solid, loaded_.brick_size);
    slivers_ += absorb_slivers(grid);
    Actor actor;
    actor.body = make_body(std::move(grid), body_.model, body_.material);
    DrawnSkin drawn;
    drawn.skin = make_skin(submesh(loaded_.mesh, solid), {.max_edge = kLongestSkinEdge * loaded_.brick_size});
    drawn.embedding = embed(actor.body.grid, drawn.skin.positions);
    drawn.color = body_.color.value_or(kPalette[production_.skins.size() % kPalette.size()]);
    actor.contacts = embed(actor.body.grid, contact_points(drawn.skin));
    actor.pinned = pinned_nodes(actor.body.rest_positions, body_.pins, loaded_.extent);
    place(actor.body, rotation_, translation_);
    actor.body.velocities.rowwise() = body_.velocity.transpose();
    for (const int node : actor.pinned) actor.body.velocities.row(node).setZero();
    outside_ += drawn.embedding.outside;
    held_solids_ += actor.pinned.empty() ? 0 : 1;
    production_.world.actors.push_back(std::move(actor));
    production_.skins.push_back(std::move(drawn));
  }

  void report(const Console& console) const {
    if (outside_ > 0) {
      console.detail(fmt::format("{}: {} skin vertices lie outside every brick and ride on the nearest one",
                                 loaded_.name, outside_));
    }
    if (slivers_ > 0) {
      console.detail(
          fmt::format("{}: {} nearly empty bricks were given to their full neighbours", loaded_.name, slivers_));
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
  const SceneBody& body_;
  const LoadedBody& loaded_;
  Production& production_;
  Mat3 rotation_;
  Vec3 translation_;
  int outside_ = 0;
  int slivers_ = 0;
  int held_solids_ = 0;
};

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
    BodyBuilder builder(scene.bodies[i], bodies[i], production);
    for (const Solid& solid : bodies[i].solids) builder.add(solid);
    builder.report(console);
    production.size = std::max(production.size, bodies[i].extent.maxCoeff());
  }
  return production;
}

Points skin_positions(const Production& production, std::size_t actor, const Points& nodes) {
  return deform_points(production.world.actors[actor].body.grid, production.skins[actor].embedding, nodes);
}

}  // namespace sprung
