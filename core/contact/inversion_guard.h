#pragma once
#include <algorithm>
#include <vector>

#include "core/contact/countdown.h"
#include "core/world/world.h"

namespace sprung {

/// At each of its corners, and between its mean axes, a brick keeps at least this share of its volume: like a sponge
/// whose pores are closed, it yields no further. Corners are checked because springs cannot tell orientation there
/// either: a brick that is merely folded, with its mean axes in order, is in a state that the springs' corrections can
/// drive on without end. And a brick can be inverted between corners that are all in order.
inline constexpr double kMinVolume = 0.1;

/// A brick that would be compressed too far in the coming step.
struct InversionRate {
  int brick;
  int corner;       // where; kMeanAxes: between its mean axes
  Mat3 gradient;    // of the volume ratio there by the three edges or axes (columns, low to high end), 1/m
  double min_rate;  // of the volume ratio that is allowed, 1/s

  static constexpr int kMeanAxes = 8;
};

/// The volume ratio between the mean axes of the flattest brick, now and after a step; 1 if none is nearly flat.
struct FlattestVolume {
  double now = 1;
  double next = 1;
};

[[nodiscard]] inline FlattestVolume flatter_of(const FlattestVolume& a, const FlattestVolume& b) {
  return {std::min(a.now, b.now), std::min(a.next, b.next)};
}

/// The gradient of the limited volume ratio with respect to the brick's corners, 1/m.
[[nodiscard]] Eigen::Matrix<double, 3, 8> corner_gradients(const InversionRate& rate);

/// Detects bricks that are about to be inverted. All bricks are checked every few steps only, those found flat or
/// collapsing in every step: it costs little in ordinary motion.
class InversionGuard {
 public:
  /// The bricks that a step of dt would compress too far; call once per step.
  [[nodiscard]] const std::vector<InversionRate>& find(const Body& body, double dt);
  /// For the step of the last find(), at the velocities that it had.
  [[nodiscard]] const FlattestVolume& flattest() const { return flattest_; }

 private:
  void look(const Body& body, double dt);

  std::vector<char> is_suspect_;  // per brick
  std::vector<int> suspects_;     // bricks
  std::vector<InversionRate> found_;
  Countdown to_look_;
  FlattestVolume flattest_;
};

}  // namespace sprung
