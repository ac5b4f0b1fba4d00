#include "core/law/hexahedron.h"

#include <numbers>

#include "core/bricks/embedding.h"
#include "core/types.h"

namespace sprung {

Eigen::Matrix<double, 6, 6> elasticity(const Material& material) {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  matrix.topLeftCorner<3, 3>().setConstant(material.lame_lambda());
  matrix.diagonal().head<3>().array() += 2 * material.shear_modulus();
  matrix.diagonal().tail<3>().setConstant(material.shear_modulus());
  return matrix;
}

namespace {

/// Strain by corner displacements at a point in the unit cube, for a cube of side h.
Eigen::Matrix<double, 6, 24> strain_by_corner(const Vec3& local, double h) {
  const Eigen::Matrix<double, 8, 3> slope = trilinear_gradients(local) / h;
  Eigen::Matrix<double, 6, 24> matrix = Eigen::Matrix<double, 6, 24>::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3;
      matrix(axis, 3 * corner + axis) = slope(corner, axis);
      matrix(3 + axis, 3 * corner + axis) = slope(corner, next);
      matrix(3 + axis, 3 * corner + next) = slope(corner, axis);
    }
  }
  return matrix;
}

}  // namespace

Eigen::Matrix<double, 24, 24> hexahedron_stiffness(const Material& material, double h) {
  const Eigen::Matrix<double, 6, 6> stress_by_strain = elasticity(material);
  const double offset = 0.5 / std::numbers::sqrt3;
  Eigen::Matrix<double, 24, 24> stiffness = Eigen::Matrix<double, 24, 24>::Zero();
  for (int point = 0; point < 8; ++point) {
    Vec3 local;
    for (int axis = 0; axis < 3; ++axis) local[axis] = on_high_side(point, axis) ? 0.5 + offset : 0.5 - offset;
    const auto strain = strain_by_corner(local, h);
    stiffness += strain.transpose() * stress_by_strain * strain * (h * h * h / 8);
  }
  return stiffness;
}

}  // namespace sprung
