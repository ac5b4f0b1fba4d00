#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/types.h"

namespace sprung {

/// Two features of two surfaces that are near each other: a point and a triangle, or two edges. Instead of a triangle
/// there may be an obstacle without edges; the last three corners are not points then.
struct FeaturePair {
  int count;                   // of the first feature's corners: 1, a point; 2, an edge
  std::array<int, 4> corners;  // points of the skins: those of the first feature, then those of the second
  std::size_t first;           // the first feature's side, 0 or 1; the second has the other

  [[nodiscard]] std::size_t side(int corner) const { return corner < count ? first : 1 - first; }
};

/// At most how fast two features approach (m/s), given the corners' speeds along the normal from the second's nearest
/// point to the first's: the features are convex, and it separates them.
[[nodiscard]] inline double closing_speed(const FeaturePair& pair, const Eigen::Vector4d& speeds) {
  const double of_last = std::max(speeds[2], speeds[3]);
  return pair.count == 1 ? std::max(speeds[1], of_last) - speeds[0] : of_last - std::min(speeds[0], speeds[1]);
}

/// A pair that may meet in the coming step.
struct AwakePair {
  static constexpr std::size_t kNoBody = std::size_t(-1);

  FeaturePair pair;
  std::array<std::size_t, 2> bodies;     // by side; kNoBody: an obstacle without edges
  Vec3 normal;                           // unit, from the second feature's nearest point to the first's
  double gap;                            // m; negative: the point lies inside, and the normal leads out
  Eigen::Vector4d weights;               // see FeatureDistance
  Vec3 obstacle_velocity{Vec3::Zero()};  // m/s, there, of one without edges
  double reach = 0;                      // m, the gap at which contact keeps them
  double friction = 0;                   // Coulomb's coefficient
  double restitution = 0;
  bool may_support = true;  // false if another pair supports the same point better
  Vec3* impulse = nullptr;  // N s, on the first feature, of the last step; kept with the pair while it is near
  bool is_loaded = false;   // when measured: whether that impulse was not zero

  [[nodiscard]] std::size_t body_of(int corner) const { return bodies[pair.side(corner)]; }
};

/// The share of the gap by which two features may approach in a step, apart from a minimum in bricks.
inline constexpr double kFreeShare = 0.8;
inline constexpr double kMinGap = 1e-5;

/// The gap, in bricks, left between guarded surfaces that rest on each other, so that most pairs sleep; and between
/// edges, which act only where points do not.
inline constexpr double kGuardedGap = 0.03;
inline constexpr double kGuardedEdges = 0.6 * kGuardedGap;

/// The share of that gap below which a point must be supported itself, even if another at its node carries a load; and
/// the share of its own gap that it may lose meanwhile without being checked.
inline constexpr double kBorne = 0.5;
inline constexpr double kSkipped = 0.45;

/// How far (m) two features may approach before they must be checked: they may then cross in a step, or be within
/// `reach` (m), where contacts begin to act. `brick` in m.
[[nodiscard]] inline double distance_until_due(double gap, double reach, double brick) {
  return std::min(kFreeShare * (gap - kMinGap * brick), gap - reach);
}

}  // namespace sprung
