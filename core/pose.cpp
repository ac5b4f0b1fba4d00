#include "core/pose.h"

#include <numbers>

namespace sprung {

Mat3 rotation_matrix(const Vec3& degrees) {
  const Vec3 angles = degrees * std::numbers::pi / 180;
  const Eigen::AngleAxisd about_x(angles.x(), Vec3::UnitX());
  const Eigen::AngleAxisd about_y(angles.y(), Vec3::UnitY());
  const Eigen::AngleAxisd about_z(angles.z(), Vec3::UnitZ());
  return (about_z * about_y * about_x).toRotationMatrix();
}

}  // namespace sprung
