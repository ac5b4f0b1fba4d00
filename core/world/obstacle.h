#pragma once
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/types.h"

namespace sprung {

/// Signed distances to a closed, outward oriented mesh, by a tree of its triangles' boxes. Cost of a query: logarithmic
/// in the triangles. May be asked by several threads at once.
class MeshDistance {
 public:
  /// `positions` m x 3, `triangles` n x 3, at least one triangle with an area.
  MeshDistance(const Points& positions, const Triangles& triangles);
  ~MeshDistance();
  MeshDistance(const MeshDistance&) = delete;
  MeshDistance& operator=(const MeshDistance&) = delete;

  struct Nearest {
    double distance;  // negative inside
    Vec3 normal;      // unit, outward: the gradient of the distance
  };
  /// Which side of the surface a point is on is told by the normal of the nearest place, at edges and vertices by the
  /// mean of the normals around it, weighted by their angles (J. Baerentzen and H. Aanaes, "Signed distance computation
  /// using the angle weighted pseudonormal", IEEE TVCG 11(3), 2005).
  [[nodiscard]] Nearest nearest(const Vec3& place) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

/// Solid where y < 0.
struct SolidHalfSpace {};
/// Around the origin; half of its sides, m.
struct SolidBox {
  Vec3 half{0.5, 0.5, 0.5};
};
/// Around the origin, m.
struct SolidBall {
  double radius = 0.5;
};
/// Around the y axis, from -half_length to half_length without its round ends, m.
struct SolidCapsule {
  double radius = 0.25;
  double half_length = 0.25;
};
/// Around the y axis, from -half_length to half_length, m.
struct SolidCylinder {
  double radius = 0.25;
  double half_length = 0.5;
};
/// Inside a closed mesh.
struct MeshSolid {
  std::shared_ptr<const MeshDistance> distance;
};

/// In a frame of their own.
using Shape = std::variant<SolidHalfSpace, SolidBox, SolidBall, SolidCapsule, SolidCylinder, MeshSolid>;

/// Something solid that no body moves. It moves evenly by itself: `pose` is where it is at the start of an advance.
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

/// After it has moved by itself for that time (s).
[[nodiscard]] Pose pose_after(const Obstacle& obstacle, double time);

/// Lets them all move by themselves for that time (s).
void move_obstacles(std::vector<Obstacle>& obstacles, double time);

/// Of the obstacle's own material at a place of the world while it is at `pose`, m/s.
[[nodiscard]] Vec3 velocity_at(const Obstacle& obstacle, const Pose& pose, const Vec3& place);

/// How far a place is from what is solid, m: negative inside; the gradient is the normal, outward. Never more than the
/// true distance.
struct Gap {
  double distance;
  Vec3 normal;
};
[[nodiscard]] Gap signed_distance(const Shape& shape, const Pose& pose, const Vec3& place);

}  // namespace sprung
