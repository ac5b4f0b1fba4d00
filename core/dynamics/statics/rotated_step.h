#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/body/body.h"
#include "core/dynamics/linear/linear_solver.h"

namespace sprung {

/// The largest rotation of a brick in a displacement, radians, that may as well go along a straight line.
inline constexpr double kSmallRotation = 0.05;

/// Turns the bricks of a body by the finite rotations that a displacement stands for. A slender part that bends turns
/// its bricks far; along a straight line from x to x + u they would stretch by half the square of their angle, and
/// Newton's method could go a small part of the way only. Here each brick is turned as a whole and deformed by what is
/// left of u, and nodes are placed such that all bricks come as near to their shapes as they can, in least squares (as
/// the global step of Sorkine and Alexa, "As-rigid-as-possible surface modeling", 2007).
class RotatedStep {
 public:
  /// Both must outlive it; supports may change.
  RotatedStep(const Body& body, const Supports& supports);

  /// Radians: the largest rotation of a brick in a displacement u (3 m, m) from `positions` (m x 3, m).
  [[nodiscard]] double largest_rotation(const Points& positions, const Eigen::VectorXd& u) const;
  /// The nodes after it. They differ from positions + u by terms of second order in u, and not at supports. Empty if
  /// their system is singular to rounding.
  [[nodiscard]] Points displaced(const Points& positions, const Eigen::VectorXd& u);

 private:
  class System;
  void prepare();
  [[nodiscard]] std::shared_ptr<System> system_along(int axis) const;

  const Body& body_;
  const Supports& supports_;
  std::vector<bool> held_;                          // 3 m: the supports of these
  std::array<std::shared_ptr<System>, 3> systems_;  // by axis
};

}  // namespace sprung
