#include "core/world/touch.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kRecoverySteps = 20;
constexpr double kLeastGravity = 0.1;  // m/s^2: without gravity too a point comes up
constexpr double kMostSteps = 24;      // what is pressed together can be fast within a few steps

}  // namespace

void add_shares(const Group& group, std::size_t actor, int brick, const Eigen::Matrix<double, 8, 1>& weights,
                Touches& touches) {
  const auto& nodes = group[actor]->body.grid.nodes[static_cast<std::size_t>(brick)];
  for (int i = 0; i < 8; ++i) {
    if (weights[i] == 0) continue;
    touches.shares.push_back({static_cast<int>(actor), nodes[static_cast<std::size_t>(i)], weights[i]});
  }
}

double least_speed(double gap, double gravity, double dt) {
  if (gap >= 0) return -gap / dt;
  return std::min(-gap / (kRecoverySteps * dt), std::sqrt(-2 * std::max(gravity, kLeastGravity) * gap));
}

int steps_until_look(double margin, double speed, double dt) {
  const double steps = margin / (4 * speed * dt);
  return steps >= 1 ? static_cast<int>(std::min(steps, kMostSteps)) : 1;
}

}  // namespace sprung
