#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <iterator>
#include <numbers>

namespace sprung {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// n x 3: one point or vector per row, row-major (x y z x y z ...).
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// n x 3: three vertex indices per row, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Empty by default.
using AlignedBox = Eigen::AlignedBox3d;

/// Empty for no points.
[[nodiscard]] inline AlignedBox bounding_box(const Points& points) {
  if (points.rows() == 0) return {};
  return {Vec3(points.colwise().minCoeff()), Vec3(points.colwise().maxCoeff())};
}

/// A rigid transform from an object's own frame to the world; the rotation comes first.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();  // m
};

/// The rotation about x, then y, then z (axes of the world).
[[nodiscard]] inline Mat3 rotation_matrix(const Vec3& degrees) {
  const Vec3 angles = degrees * std::numbers::pi / 180;
  const Eigen::AngleAxisd about_x(angles.x(), Vec3::UnitX());
  const Eigen::AngleAxisd about_y(angles.y(), Vec3::UnitY());
  const Eigen::AngleAxisd about_z(angles.z(), Vec3::UnitZ());
  return (about_z * about_y * about_x).toRotationMatrix();
}

/// Trilinear weights of a brick's eight corners at a point; they sum to 1.
using CornerWeights = Eigen::Matrix<double, 8, 1>;

/// The size of a container as an int, the type of all indices here.
template <class Container>
[[nodiscard]] constexpr int isize(const Container& container) {
  return int(std::size(container));
}

}  // namespace sprung
