#include "core/simulation/obstacles.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/repair/solids.h"
#include "core/simulation/shapes.h"
#include "core/types.h"

namespace sprung {
namespace {

constexpr Color kColor{0x9a, 0xa4, 0xae};
constexpr double kThin = 0.01;  // thickness of a drawn plane, over half its side

/// An obstacle's solid and its drawn surface.
struct Made {
  Shape shape;
  SurfaceMesh mesh;
};

/// Drawn as a thin slab.
Made make_plane(double room) {
  const double thickness = kThin * room;
  Made made{SolidHalfSpace{}, box_mesh({2 * room, thickness, 2 * room})};
  made.mesh.positions.col(1).array() -= thickness / 2;
  return made;
}

Made make_mesh(const SceneObstacle& obstacle, const Observer& observer) {
  Made made{MeshSolid{}, read_mesh(obstacle.mesh)};
  const std::string name = obstacle.mesh.filename().string();
  for (const std::string& note : made.mesh.notes) observer.warn(fmt::format("{}: {}", name, note));
  const Solids found = find_solids(made.mesh, obstacle.mesh.string(), {});
  for (const Repair& repair : found.repairs) {
    if (!repair.harmless) observer.warn(fmt::format("{}: {}", name, repair.text));
  }
  const Vec3 low = made.mesh.positions.colwise().minCoeff();
  const Vec3 high = made.mesh.positions.colwise().maxCoeff();
  const double scale = obstacle.scale ? *obstacle.scale : obstacle.size.value() / (high - low).maxCoeff();
  const auto placed = [&](const Points& points) {
    return Points((points.rowwise() - ((low + high) / 2).transpose()) * scale);
  };
  // The surfaces of all solids, concatenated.
  Points points(0, 3);
  Triangles triangles(0, 3);
  for (const Solid& solid : found.solids) {
    const auto first = int(points.rows());
    const auto before = triangles.rows();
    points.conservativeResize(first + solid.points.rows(), 3);
    points.bottomRows(solid.points.rows()) = placed(solid.points);
    triangles.conservativeResize(before + solid.triangles.rows(), 3);
    triangles.bottomRows(solid.triangles.rows()) = solid.triangles.array() + first;
  }
  made.shape = MeshSolid{std::make_shared<MeshDistance>(points, triangles)};
  made.mesh.positions = placed(made.mesh.positions);
  return made;
}

Made make(const SceneObstacle& obstacle, double room, const Observer& observer) {
  if (obstacle.plane) return make_plane(room);
  if (obstacle.box) return {SolidBox{*obstacle.box / 2}, box_mesh(*obstacle.box)};
  if (obstacle.sphere) return {SolidBall{obstacle.sphere->radius}, mesh_of(*obstacle.sphere)};
  if (obstacle.capsule) {
    return {SolidCapsule{obstacle.capsule->radius, obstacle.capsule->height / 2}, mesh_of(*obstacle.capsule)};
  }
  if (obstacle.cylinder) {
    return {SolidCylinder{obstacle.cylinder->radius, obstacle.cylinder->height / 2}, mesh_of(*obstacle.cylinder)};
  }
  return make_mesh(obstacle, observer);
}

Pose start_of(const SceneObstacle& obstacle) {
  Pose pose{rotation_matrix(obstacle.rotation), obstacle.position};
  if (!obstacle.plane) return pose;
  const Vec3 normal = obstacle.plane->normal.normalized();
  pose.translation += pose.rotation.col(1) * obstacle.plane->y;
  // Exactly upright where it is meant to be, since level ground is recognised by that.
  if (normal != Vec3::UnitY()) {
    pose.rotation = pose.rotation * Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(), normal);
  }
  return pose;
}

}  // namespace

std::vector<StageObstacle> make_obstacles(const Scene& scene, double room, const Observer& observer) {
  std::vector<StageObstacle> all;
  for (const SceneObstacle& obstacle : scene.obstacles) {
    Made made = make(obstacle, room, observer);
    StageObstacle& staged = all.emplace_back();
    staged.shape = std::move(made.shape);
    staged.start = start_of(obstacle);
    staged.movement = {obstacle.keyframes, obstacle.interpolation};
    staged.color = obstacle.color.value_or(kColor);
    const bool is_ground = ground_height({.shape = staged.shape, .pose = staged.start}) && staged.movement.is_still();
    if (!is_ground) staged.skin = make_skin(made.mesh, {});
  }
  return all;
}

Pose pose_at(const StageObstacle& obstacle, double time) {
  if (obstacle.movement.is_still()) return obstacle.start;
  const Placement placement = obstacle.movement.placement(time);
  return {placement.rotation * obstacle.start.rotation, obstacle.start.translation + placement.shift};
}

Points skin_positions(const StageObstacle& obstacle, double time) {
  const Pose pose = pose_at(obstacle, time);
  return (obstacle.skin.positions * pose.rotation.transpose()).rowwise() + pose.translation.transpose();
}

Obstacle obstacle_between(const StageObstacle& staged, const SceneObstacle& obstacle, double begin, double end) {
  Obstacle moving{.shape = staged.shape,
                  .pose = pose_at(staged, begin),
                  .friction = obstacle.friction,
                  .restitution = obstacle.restitution};
  if (staged.movement.is_still() || !(end > begin)) return moving;
  const Pose next = pose_at(staged, end);
  moving.velocity = (next.translation - moving.pose.translation) / (end - begin);
  const Eigen::AngleAxisd turn(Mat3(next.rotation * moving.pose.rotation.transpose()));
  moving.spin = turn.angle() / (end - begin) * turn.axis();
  return moving;
}

}  // namespace sprung
