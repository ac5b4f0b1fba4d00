#pragma once
#include <vector>

#include "core/world/world.h"

namespace sprung {

/// At each of its corners, and between its mean axes, a brick keeps at least this share of its volume: like a sponge
/// whose pores are closed, it yields no further. The volume guard of its law works below 0.3 and grows with the
/// stiffness; this does not. It looks at the corners because springs do not know left from right there either: a brick
/// that is only folded, its mean axes in order, has found a state that the springs' corrections can push on without
/// end. And a brick can be turned over between corners that are all in order.
inline constexpr double kLeastVolume = 0.1;

/// How fast anything in a world may be when it meets something, m/s: as it starts, with the fall from where it is to
/// the lowest thing there. 0 where there is nothing to meet. Obstacles' later movements are not known to it.
[[nodiscard]] double impact_speed(const World& world);

/// Makes the volume guard of a body strong enough for what it meets, where its material is softer than that: the
/// pressure of its own weight, density g length, and that of stopping from `speed` (m/s), density speed^2. Call before
/// the first step is chosen; a guard costs step size. Bodies that are stiff enough stay as they are.
void stiffen_volume_guard(Body& body, double gravity, double speed);

/// How many bricks have less than the volume at which the guard of their law begins to act.
[[nodiscard]] int guarded_bricks(const Body& body);

/// Whether those are more than a few: it is the guard that carries the body then, not its springs, and its shape is not
/// what the material would do. So it is where the pressure of its weight, density g length, is well above Young's
/// modulus: springs linear in their stretch bear about that much and no more.
[[nodiscard]] bool is_crushed(const Body& body);

/// A brick that would be pressed too far in the step to come.
struct InversionRate {
  int brick;
  int corner;         // where; kMeanAxes: between its mean axes
  Mat3 gradient;      // of the volume ratio there by the three edges or axes (columns, low to high end), 1/m
  double least_rate;  // of the volume ratio that is allowed, 1/s

  static constexpr int kMeanAxes = 8;
};

/// Of the limited volume ratio by the brick's corners, 1/m.
[[nodiscard]] Eigen::Matrix<double, 3, 8> corner_gradients(const InversionRate& rate);

/// Watches for bricks that are about to be turned inside out. All bricks are looked at every few steps only, those
/// found flat or collapsing then in every step: in ordinary motion it costs little.
class InversionGuard {
 public:
  /// What moving by dt would press too far; call once a step.
  [[nodiscard]] const std::vector<InversionRate>& find(const Body& body, double dt);

 private:
  void look(const Body& body, double dt);

  std::vector<char> is_suspect_;  // a brick
  std::vector<int> suspects_;     // bricks
  std::vector<InversionRate> found_;
  int steps_to_update_ = 0;
};

}  // namespace sprung
