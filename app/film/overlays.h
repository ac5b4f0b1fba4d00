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

/// One number per rod each, or none.
struct RodLooks {
  Eigen::VectorXd coordinates{};  // on the colour map
  Eigen::VectorXd widths{};       // factors of the radius
  Eigen::VectorXd opacities{};    // SkinShape::opacities
};

/// Three-sided prisms between pairs of points, for springs and traces, which are too thin for their shading to show.
class Rods {
 public:
  /// `radius` in m.
  Rods(std::size_t count, double radius);
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// Rod i goes from from[i] to to[i].
  [[nodiscard]] SkinShape shape(const Points& from, const Points& to, const RodLooks& looks = {}) const;
  /// Rod i goes from one point of a pair to the other.
  [[nodiscard]] SkinShape between(const Points& points, const std::vector<std::array<int, 2>>& pairs,
                                  const RodLooks& looks = {}) const;

 private:
  double radius_;
  Skin skin_;
};

/// Each edge once.
[[nodiscard]] std::vector<std::array<int, 2>> edges_of(const Triangles& triangles);

/// Points and triangles of a sphere of radius 1.
struct RoundShape {
  std::vector<Vec3> positions;
  std::vector<std::array<int, 3>> triangles;
};

/// Balls of one radius, for nodes, pins and contacts.
class Balls {
 public:
  Balls(std::size_t count, double radius);
  [[nodiscard]] const Skin& skin() const { return skin_; }
  /// `centers` (at most `count` x 3, m); balls beyond them shrink to the point `idle`.
  [[nodiscard]] SkinShape shape(const Points& centers, const Vec3& idle = Vec3::Zero()) const;

 private:
  double radius_;
  RoundShape round_;
  Skin skin_;
};

/// The springs of a body without duplicates: pairs of nodes and rest lengths.
struct SpringSet {
  std::vector<std::array<int, 2>> nodes;
  Eigen::VectorXd rest;  // m

  /// Length over rest length, minus 1, for these positions of the nodes (m x 3, m).
  [[nodiscard]] Eigen::VectorXd stretches(const Points& positions) const;
};

/// Edges, and the diagonals that the body's law has, of the bricks that are `shown` (one flag per brick).
[[nodiscard]] SpringSet springs_of(const Body& body, const std::vector<bool>& shown);

/// Finds contacts of bodies with the ground, obstacles and each other from their skins alone, so that it works for
/// caches too.
class Contacts {
 public:
  /// The simulation must outlive it.
  explicit Contacts(const Simulation& simulation);

  /// Vertices of skins (n x 3, m) within a small fraction of a brick of another skin, an obstacle or the ground, at
  /// most one per cell of half a brick. `nodes` by body, m; `time` (s) places the obstacles.
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

/// Flags of the bricks that a cut leaves: those whose centres at rest are not on the side that its normal points to.
[[nodiscard]] std::vector<bool> bricks_left(const BrickGrid& grid, const std::optional<HalfSpace>& cut);

}  // namespace sprung
