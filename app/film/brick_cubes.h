#pragma once
#include <array>
#include <optional>
#include <vector>

#include "app/build_world.h"
#include "app/scene/scene_render.h"
#include "core/bricks/brick_grid.h"
#include "render/renderer.h"

namespace sprung {

/// Which bricks of a grid a cut leaves, seen at rest: their middles are not on the side to which its normal points.
[[nodiscard]] std::vector<bool> bricks_left(const BrickGrid& grid, const std::optional<HalfSpace>& cut);

/// The bricks of a body as cubes that bend with it: the outer faces of those that are shown, edges a little darker; or
/// each cube by itself, smaller than it is, so that gaps open between them.
class BrickCubes {
 public:
  BrickCubes(const BrickGrid& grid, const std::vector<bool>& shown, bool exploded, const Eigen::Vector3f& color);

  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// For these positions of the nodes (m x 3, m); `shares` of the nodes on the colour map, or none.
  [[nodiscard]] SkinShape shape(const Points& nodes, const Eigen::VectorXd& shares) const;

 private:
  void lay_out(const Eigen::Vector3f& color);
  [[nodiscard]] std::array<Vec3, 4> corners(const BrickFace& face, const Points& nodes) const;

  const BrickGrid& grid_;
  bool exploded_;
  double rim_;  // of a face
  std::vector<BrickFace> faces_;
  Skin skin_;
};

}  // namespace sprung
