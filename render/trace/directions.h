#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sprung {

/// Axes at right angles to a unit vector: T. Duff et al., "Building an Orthonormal Basis, Revisited" (2017).
struct TangentFrame {
  Eigen::Vector3f x, y, normal;

  explicit TangentFrame(const Eigen::Vector3f& n) : normal(n) {
    const float sign = std::copysign(1.0F, n.z());
    const float a = -1 / (sign + n.z());
    const float b = n.x() * n.y() * a;
    x = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
    y = {b, sign + n.y() * n.y() * a, -n.y()};
  }
  [[nodiscard]] Eigen::Vector3f to_world(const Eigen::Vector3f& local) const {
    return local.x() * x + local.y() * y + local.z() * normal;
  }
  [[nodiscard]] Eigen::Vector3f to_local(const Eigen::Vector3f& world) const {
    return {world.dot(x), world.dot(y), world.dot(normal)};
  }
};

/// The i-th of side x side points in the middle of equal parts of the unit square.
[[nodiscard]] inline Eigen::Vector2f on_grid(int i, int side) {
  const int row = i / side;
  return Eigen::Vector2f(float(i % side) + 0.5F, float(row) + 0.5F) / float(side);
}

/// Samples the unit disc uniformly.
[[nodiscard]] inline Eigen::Vector2f on_disc(const Eigen::Vector2f& random) {
  const float radius = std::sqrt(random.x());
  const float turn = 2 * std::numbers::pi_v<float> * random.y();
  return {radius * std::cos(turn), radius * std::sin(turn)};
}

/// Samples the hemisphere about z, with a density of its cosine over pi.
[[nodiscard]] inline Eigen::Vector3f on_cosine_hemisphere(const Eigen::Vector2f& random) {
  const Eigen::Vector2f disc = on_disc(random);
  return {disc.x(), disc.y(), std::sqrt(std::max(0.0F, 1 - random.x()))};
}

}  // namespace sprung
