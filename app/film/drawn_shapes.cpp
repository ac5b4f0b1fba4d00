#include "app/film/drawn_shapes.h"

#include "core/bricks/embedding.h"

namespace sprung {
Eigen::Vector3f srgb(const Color& color) { return Eigen::Vector3f(color.red, color.green, color.blue) / 255.0F; }

SkinShape shape_of(const Production& production, std::size_t actor, const Points& nodes, SkinInterpolation riding) {
  const DrawnSkin& drawn = production.skins[actor];
  const BrickGrid& grid = production.world.actors[actor].body.grid;
  if (riding == SkinInterpolation::kSmooth) {
    const SmoothEmbedding ride(grid, nodes);
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

Points skin_positions(const StageObstacle& obstacle, double time) {
  const Pose pose = pose_at(obstacle, time);
  return (obstacle.skin.positions * pose.rotation.transpose()).rowwise() + pose.translation.transpose();
}

}  // namespace sprung
