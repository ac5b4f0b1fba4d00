#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "render/stage/stage.h"
#include "render/stage/stage_space.h"
#include "render/trace/ray_scene.h"

namespace sprung {

/// The regions of the bodies, and of the floor whose light they affect: around them and their shadows. Stage space.
class BodyRegion {
 public:
  BodyRegion() = default;
  /// `height`: of the floor.
  BodyRegion(const Motion& motion, const StageSpace& space, double height, const Vec3& to_key);

  /// The weight of the bodies' effect on the light at a point of the floor: 1 near them, 0 far away.
  [[nodiscard]] float weight_on_floor(const Eigen::Vector3f& point) const;
  /// False if the ray certainly meets no body.
  [[nodiscard]] bool is_met_by(const Ray& ray) const;

 private:
  /// A body and its shadow, seen from above.
  struct Felt {
    Eigen::AlignedBox2f rectangle;  // x, z
    float radius;                   // of the body
  };
  /// Distance to the nearest body, in its radii; 0 beneath it.
  [[nodiscard]] float distance_on_floor(const Eigen::Vector3f& point) const;

  Eigen::AlignedBox3f bodies_;
  std::vector<Felt> felt_;
};

}  // namespace sprung
