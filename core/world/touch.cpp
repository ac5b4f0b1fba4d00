#include "core/world/touch.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kRecoverySteps = 20;
constexpr double kLeastGravity = 0.1;  // m/s^2: without gravity too a point comes up
constexpr double kMostSteps = 24;      // what is pressed together can be fast within a few steps

}  // namespace

double least_speed(double gap, double gravity, double dt) {
  if (gap >= 0) return -gap / dt;
  return std::min(-gap / (kRecoverySteps * dt), std::sqrt(-2 * std::max(gravity, kLeastGravity) * gap));
}

int steps_until_look(double margin, double speed, double dt) {
  const double steps = margin / (4 * speed * dt);
  return steps >= 1 ? static_cast<int>(std::min(steps, kMostSteps)) : 1;
}

}  // namespace sprung
