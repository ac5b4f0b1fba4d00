#pragma once
#include <Eigen/Core>

#include "render/stage/camera.h"
#include "render/stage/stage_space.h"
#include "render/trace/ray_scene.h"

namespace sprung {

/// The rays of a camera through its picture, in stage space.
class CameraRays {
 public:
  /// `aspect`: width / height of the picture.
  CameraRays(const Camera& camera, const StageSpace& space, double aspect);

  /// Through (x, y) of the picture, 0 to 1 from the top left, and a point of the lens (both random, 0 to 1).
  [[nodiscard]] Ray through(const Eigen::Vector2f& position, const Eigen::Vector2f& lens) const;
  [[nodiscard]] bool has_lens() const { return lens_radius_ > 0; }

 private:
  Eigen::Vector3f eye_;
  Eigen::Vector3f ahead_;
  Eigen::Vector3f right_;
  Eigen::Vector3f up_;
  float half_width_;
  float half_height_;
  float shift_;
  float lens_radius_;
  float focus_;  // distance along the axis
  bool is_parallel_;
};

}  // namespace sprung
