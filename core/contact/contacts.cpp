#include "core/contact/contacts.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kRecoverySteps = 20;

}  // namespace

Vec3 within_friction_cone(const Vec3& impulse, const Vec3& normal, double friction) {
  const double normal_force = impulse.dot(normal);
  if (!(normal_force > 0)) return Vec3::Zero();
  const Vec3 sideways = impulse - normal_force * normal;
  const double length = sideways.norm();
  const double most = friction * normal_force;
  return length > most ? Vec3(normal_force * normal + most / length * sideways) : impulse;
}

double min_speed(double gap, double gravity, double dt) {
  if (gap >= 0) return -gap / dt;
  return std::min(-gap / (kRecoverySteps * dt), std::sqrt(-2 * std::max(gravity, kMinGravity) * gap));
}

}  // namespace sprung
