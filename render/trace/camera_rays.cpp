#include "render/trace/camera_rays.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "render/trace/directions.h"

namespace sprung {
namespace {

constexpr float kBehind = 4;  // where parallel rays start, behind the eye: a body may be there

}  // namespace

CameraRays::CameraRays(const Camera& camera, const StageSpace& space, double aspect)
    : eye_(space.from_world(camera.eye).cast<float>()),
      ahead_((camera.target - camera.eye).normalized().cast<float>()),
      right_((camera.target - camera.eye).cross(camera.up).normalized().cast<float>()),
      up_(right_.cross(ahead_)),
      half_height_(float(std::tan(camera.vertical_field_of_view * std::numbers::pi / 360))),
      shift_(float(camera.shift)),
      lens_radius_(float(0.5 * camera.aperture * space.scale)),
      focus_(float((camera.target - camera.eye).norm() * space.scale)),
      is_parallel_(camera.orthographic) {
  if (is_parallel_) half_height_ *= focus_;
  half_width_ = half_height_ * float(aspect);
}

Ray CameraRays::through(const Eigen::Vector2f& position, const Eigen::Vector2f& lens) const {
  const Eigen::Vector3f aside =
      half_width_ * (2 * position.x() - 1 - shift_) * right_ + half_height_ * (1 - 2 * position.y()) * up_;
  Ray ray;
  ray.origin = is_parallel_ ? (eye_ + aside).eval() : eye_;
  ray.direction = is_parallel_ ? ahead_ : (ahead_ + aside).eval();
  if (lens_radius_ > 0) {
    const Eigen::Vector2f at = lens_radius_ * on_disc(lens);
    const Eigen::Vector3f sharp = ray.origin + focus_ * ray.direction;
    ray.origin += at.x() * right_ + at.y() * up_;
    ray.direction = sharp - ray.origin;
  }
  ray.direction.normalize();
  if (is_parallel_) ray.origin -= kBehind * ray.direction;
  return ray;
}

}  // namespace sprung
