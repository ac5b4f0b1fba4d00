#pragma once
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// A ray in stage space.
struct Ray {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::UnitY();  // unit
  float far = std::numeric_limits<float>::infinity();
  float time = 0;  // 0 to 1 while the shutter is open
};

/// Where a ray meets a triangle.
struct RayHit {
  int skin;
  int triangle;
  float u, v;  // weights of the triangle's second and third corner
  float distance;
  Eigen::Vector3f normal;  // of the triangle, any length, by the order of its corners
};

/// The triangles of all skins as Embree finds them; moving skins are interpolated linearly between the given times.
/// Results do not depend on the number of threads.
class RayScene {
 public:
  [[nodiscard]] static bool is_available();
  /// Both by skin; ghosts occlude nothing. Throws Error(kFailed) if this program was built without Embree.
  RayScene(const std::vector<const Triangles*>& triangles, const std::vector<bool>& is_ghost);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Positions (n x 3, stage space) by time, which must be as many for all skins, and skin. `opacities`: by skin and
  /// triangle, none for opaque skins; the others cast no shadow.
  void update(const std::vector<std::vector<Floats3>>& positions, std::vector<std::vector<float>> opacities = {});

  /// These two may run on several threads.
  /// Hits opaque skins, and what is more opaque than `opacity` (0 to 1) in others.
  [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray, float opacity = 1) const;
  [[nodiscard]] bool is_blocked(const Ray& ray) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace sprung
