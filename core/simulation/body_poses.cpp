#include "core/simulation/body_poses.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace sprung {
namespace {

/// Random numbers that are equal on all platforms, unlike those of the standard's distributions.
class Chance {
 public:
  explicit Chance(int seed) : engine_(static_cast<std::uint64_t>(seed)) {}

  /// In [low, high).
  double between(double low, double high) { return low + (high - low) * std::ldexp(engine_() >> 11U, -53); }
  Vec3 in_cube(double reach) {
    const double x = between(-reach, reach);
    const double y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
  }
  Vec3 direction() {
    const double height = between(-1, 1);
    const double angle = between(0, 2 * std::numbers::pi);
    const double radius = std::sqrt(1 - height * height);
    return {radius * std::cos(angle), radius * std::sin(angle), height};
  }

 private:
  std::mt19937_64 engine_;
};

/// Moves the bottom centre of the rotated body's bounding box to `position`.
Pose pose_at(const Vec3& position, const Mat3& rotation, const LoadedBody& loaded) {
  const Points flipped = loaded.mesh.positions * rotation.transpose();
  const Vec3 low = flipped.colwise().minCoeff();
  const Vec3 high = flipped.colwise().maxCoeff();
  const Vec3 middle = (low + high) / 2;
  return {.rotation = rotation, .translation = position - Vec3(middle.x(), low.y(), middle.z())};
}

}  // namespace

std::vector<Pose> poses_of(const SceneBody& body, const LoadedBody& loaded) {
  const Mat3 rotation = rotation_matrix(body.rotation) * loaded.bricks_from_rest.transpose();
  if (!body.copies) return {pose_at(body.position, rotation, loaded)};
  const Copies& copies = *body.copies;
  Chance chance(copies.seed);
  std::vector<Pose> poses;
  for (int k = 0; k < copies.count[2]; ++k) {
    for (int j = 0; j < copies.count[1]; ++j) {
      for (int i = 0; i < copies.count[0]; ++i) {
        const Vec3 position =
            body.position + Vec3(i, j, k).cwiseProduct(copies.spacing) + chance.in_cube(copies.scatter);
        const double turn = chance.between(0, copies.turn) * std::numbers::pi / 180;
        const Vec3 axis = chance.direction();
        poses.push_back(pose_at(position, Eigen::AngleAxisd(turn, axis) * rotation, loaded));
      }
    }
  }
  return poses;
}

}  // namespace sprung
