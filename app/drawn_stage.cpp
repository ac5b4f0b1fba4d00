#include "app/drawn_stage.h"

#include "core/bricks/smooth_ride.h"

namespace sprung {
namespace {

Eigen::Vector3f shade(const Color& color) { return Eigen::Vector3f(color.red, color.green, color.blue) / 255.0F; }

}  // namespace

Stage stage_of(const Production& production, const Bounds& bounds) {
  Stage stage;
  for (const DrawnSkin& drawn : production.skins) {
    stage.skins.push_back(&drawn.skin);
    stage.default_colors.push_back(shade(drawn.color));
  }
  for (const StageObstacle& obstacle : production.obstacles) {
    if (obstacle.skin.positions.rows() == 0) continue;
    stage.skins.push_back(&obstacle.skin);
    stage.default_colors.push_back(shade(obstacle.color));
  }
  const std::optional<double> ground = ground_height(production.world.obstacles);
  stage.has_ground = ground.has_value();
  if (ground) stage.ground.height = *ground;
  stage.bounds = bounds;
  return stage;
}

SkinShape shape_of(const Production& production, std::size_t actor, const Points& nodes, Riding riding) {
  const DrawnSkin& drawn = production.skins[actor];
  const BrickGrid& grid = production.world.actors[actor].body.grid;
  if (riding == Riding::kSmooth) {
    const SmoothRide ride(grid, nodes);
    return {.positions = ride.points(drawn.embedding).cast<float>(),
            .normals = ride.normals(drawn.embedding, drawn.skin.normals).cast<float>()};
  }
  return {.positions = skin_positions(production, actor, nodes).cast<float>(),
          .normals = deform_normals(grid, drawn.embedding, drawn.skin.normals, nodes).cast<float>()};
}

SkinShape shape_of(const StageObstacle& obstacle, double time) {
  const Points normals = obstacle.skin.normals * pose_at(obstacle, time).rotation.transpose();
  return {.positions = skin_positions(obstacle, time).cast<float>(), .normals = normals.cast<float>()};
}

std::vector<SkinShape> shapes_of(const Production& production, const std::vector<Floats3>& nodes, double time) {
  std::vector<SkinShape> shapes;
  for (std::size_t actor = 0; actor < nodes.size(); ++actor) {
    shapes.push_back(shape_of(production, actor, nodes[actor].cast<double>()));
  }
  for (const StageObstacle& obstacle : production.obstacles) {
    if (obstacle.skin.positions.rows() > 0) shapes.push_back(shape_of(obstacle, time));
  }
  return shapes;
}

Points skin_positions(const StageObstacle& obstacle, double time) {
  const Pose pose = pose_at(obstacle, time);
  return (obstacle.skin.positions * pose.rotation.transpose()).rowwise() + pose.translation.transpose();
}

}  // namespace sprung
