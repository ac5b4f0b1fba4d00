#include "core/contact/search/rigid_motion.h"

#include <Eigen/Cholesky>

namespace sprung {

RigidMotion rigid_motion_of(std::span<const MovingMass> masses) {
  Vec3 middle = Vec3::Zero();
  Vec3 mean = Vec3::Zero();
  double mass = 0;
  for (const MovingMass& one : masses) {
    middle += one.mass * one.position;
    mean += one.mass * one.velocity;
    mass += one.mass;
  }
  middle /= mass;
  mean /= mass;
  Mat3 second = Mat3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
  for (const MovingMass& one : masses) {
    const Vec3 arm = one.position - middle;
    second += one.mass * arm * arm.transpose();
    angular_momentum += one.mass * arm.cross(one.velocity);
  }
  const Mat3 inertia = second.trace() * Mat3::Identity() - second;
  const Vec3 spin = inertia.ldlt().solve(angular_momentum);
  if (!spin.allFinite()) return {mean, Vec3::Zero()};
  return {mean - spin.cross(middle), spin};
}

}  // namespace sprung
