#include "app/film/drawn_shapes.h"

#include "core/bricks/embedding.h"

namespace sprung {
Eigen::Vector3f srgb(const Color& color) { return Eigen::Vector3f(color.red, color.green, color.blue) / 255.0F; }

SkinShape shape_of(const SoftBody& body, const Points& nodes, SkinInterpolation interpolation) {
  if (interpolation == SkinInterpolation::kSmooth) {
    const SmoothEmbedding smooth(body.grid, nodes);
    return {.positions = smooth.points(body.skin_embedding).cast<float>(),
            .normals = smooth.normals(body.skin_embedding, body.skin.normals).cast<float>()};
  }
  return {.positions = body.skin_positions(nodes).cast<float>(),
          .normals = deform_normals(body.grid, body.skin_embedding, body.skin.normals, nodes).cast<float>()};
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
