#pragma once
#include <array>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/skin/skin.h"
#include "render/renderer.h"

namespace sprung {

/// The bricks of a body as cubes that deform with it, each face with a darker rim: either the outer faces of all cubes
/// together, or every cube by itself, shrunk towards its middle so that gaps open between them.
class BrickCubes {
 public:
  /// Cubes of the bricks that are `shown`; `colors` (sRGB): one per brick. The grid outlives it.
  BrickCubes(const BrickGrid& grid, const std::vector<bool>& shown, bool exploded,
             const std::vector<Eigen::Vector3f>& colors);

  /// Triangles and colours, without positions and normals: those of a shape().
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// The shape for these positions of the nodes (m x 3, m); `coordinates` of the nodes on the colour map, or none.
  [[nodiscard]] SkinShape shape(const Points& nodes, const Eigen::VectorXd& coordinates = {}) const;

 private:
  [[nodiscard]] std::array<Vec3, 4> corners(const BrickFace& face, const Points& nodes) const;

  const BrickGrid& grid_;
  bool exploded_;
  std::vector<BrickFace> faces_;
  Skin skin_;
};

/// The skin with the positions and normals of a shape.
[[nodiscard]] Skin with_shape(Skin skin, const SkinShape& shape);

}  // namespace sprung
