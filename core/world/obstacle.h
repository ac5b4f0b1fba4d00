#pragma once
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Signed distances to a closed, outward-oriented mesh, by a bounding box tree. Queries cost O(log n) and are
/// thread-safe.
class MeshDistance {
 public:
  /// `positions` m x 3, `triangles` n x 3, at least one of non-zero area.
  MeshDistance(const Points& positions, const Triangles& triangles);
  ~MeshDistance();
  MeshDistance(const MeshDistance&) = delete;
  MeshDistance& operator=(const MeshDistance&) = delete;

  struct Nearest {
    double distance;  // negative inside
    Vec3 normal;      // unit, outward: the gradient of the distance
  };
  /// The sign follows from the normal at the closest point of the surface, at edges and vertices from the
  /// angle-weighted mean of the adjacent normals (J. Baerentzen and H. Aanaes, "Signed distance computation using the
  /// angle weighted pseudonormal", IEEE TVCG 11(3), 2005).
  [[nodiscard]] Nearest nearest(const Vec3& position) const;

  [[nodiscard]] const Points& positions() const;
  [[nodiscard]] const Triangles& triangles() const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

/// Solid where y < 0.
struct SolidHalfSpace {
  bool operator==(const SolidHalfSpace&) const = default;
};
/// Centred at the origin; half side lengths, m.
struct SolidBox {
  Vec3 half{0.5, 0.5, 0.5};
  bool operator==(const SolidBox&) const = default;
};
/// Around the origin, m.
struct SolidBall {
  double radius = 0.5;
  bool operator==(const SolidBall&) const = default;
};
/// About the y axis, from -half_length to half_length without its round ends, m.
struct SolidCapsule {
  double radius = 0.25;
  double half_length = 0.25;
  bool operator==(const SolidCapsule&) const = default;
};
/// About the y axis, from -half_length to half_length, m.
struct SolidCylinder {
  double radius = 0.25;
  double half_length = 0.5;
  bool operator==(const SolidCylinder&) const = default;
};
/// Inside a closed mesh.
struct MeshSolid {
  std::shared_ptr<const MeshDistance> distance;
  bool operator==(const MeshSolid&) const = default;
};

/// In the obstacle's own frame.
using Shape = std::variant<SolidHalfSpace, SolidBox, SolidBall, SolidCapsule, SolidCylinder, MeshSolid>;

/// A rigid obstacle with prescribed, uniform motion. `pose`: at the start of a step.
struct Obstacle {
  Shape shape = SolidHalfSpace{};
  Pose pose;
  Vec3 velocity = Vec3::Zero();  // of pose.translation, m/s
  Vec3 spin = Vec3::Zero();      // about pose.translation, rad/s
  double friction = 0.5;         // Coulomb's coefficient
  double restitution = 0;        // of a single contact point; a soft body bounces by its own elasticity

  [[nodiscard]] bool is_moving() const { return !velocity.isZero(0) || !spin.isZero(0); }
};

/// The half-space y < height.
[[nodiscard]] Obstacle level_ground(double height, double friction = 0.5, double restitution = 0);

/// The height of an obstacle that is level ground at rest, m.
[[nodiscard]] std::optional<double> ground_height(const Obstacle& obstacle);

/// The highest level ground among them, or null; and its height.
[[nodiscard]] const Obstacle* highest_ground(const std::vector<Obstacle>& obstacles);
[[nodiscard]] std::optional<double> ground_height(const std::vector<Obstacle>& obstacles);

/// The pose after `time` (s) of its own motion.
[[nodiscard]] Pose pose_after(const Obstacle& obstacle, double time);

/// Moves all obstacles by `time` (s).
void move_obstacles(std::vector<Obstacle>& obstacles, double time);

/// The velocity of the obstacle's material at a point of the world, m/s.
[[nodiscard]] Vec3 velocity_at(const Obstacle& obstacle, const Pose& pose, const Vec3& position);

/// The distance of a point from a solid, m, negative inside, and its gradient, the outward normal. Never more than the
/// true distance.
struct Gap {
  double distance;
  Vec3 normal;
};
[[nodiscard]] Gap signed_distance(const Shape& shape, const Pose& pose, const Vec3& position);

}  // namespace sprung
