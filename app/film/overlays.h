#pragma once
#include <array>
#include <optional>
#include <vector>

#include "app/scene/scene_render.h"
#include "core/body/body.h"
#include "core/bricks/brick_grid.h"
#include "core/mesh/query/closest_triangle.h"
#include "core/simulation/simulation.h"
#include "render/renderer.h"

namespace sprung {

/// Straight rods between points, three-sided and seen from outside; and balls. For springs, nodes and ways,
/// which are thinner than what their light would show.
class Rods {
 public:
  /// `radius` in metres.
  Rods(std::size_t count, double radius);
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// Rod i goes from from[i] to to[i]; `shares` one a rod on the colour map, or none.
  [[nodiscard]] SkinShape shape(const Points& from, const Points& to, const Eigen::VectorXd& shares) const;

 private:
  double radius_;
  Skin skin_;
};

class Balls {
 public:
  Balls(std::size_t count, double radius);
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// Those that have no middle (at most as many x 3, m) shrink to a point, `idle`.
  [[nodiscard]] SkinShape shape(const Points& middles, const Vec3& idle = Vec3::Zero()) const;

 private:
  double radius_;
  Skin skin_;
};

/// The springs of a body, each once: pairs of nodes and lengths at rest.
struct SpringSet {
  std::vector<std::array<int, 2>> nodes;
  Eigen::VectorXd rest;  // m

  /// Length over length at rest, less 1, for these positions of the nodes (m x 3, m).
  [[nodiscard]] Eigen::VectorXd stretches(const Points& positions) const;
};

/// Edges, and the diagonals that the body's law has, of the bricks that are `shown` (one a brick).
[[nodiscard]] SpringSet springs_of(const Body& body, const std::vector<bool>& shown);

/// Finds where bodies touch the ground, obstacles and each other, by their skins alone: from a cache as well.
class Contacts {
 public:
  /// Outlived by the simulation.
  explicit Contacts(const Simulation& simulation);

  /// Places (n x 3, m) where a skin's vertex is nearer to another skin or to the ground than a small part of a brick,
  /// one at most in each cell of half a brick. `nodes` by actor; `time` (s) says where the obstacles are.
  [[nodiscard]] Points at(const std::vector<Points>& nodes, double time) const;

 private:
  struct Solid {
    const StageObstacle* obstacle;
    NearestTriangle surface;  // in the obstacle's frame
  };

  const Simulation& simulation_;
  std::optional<double> ground_;
  std::vector<Solid> solids_;
};

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
