#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/types.h"

namespace sprung {

/// Two features of two surfaces that are near each other: a point and a triangle, or two edges. In place of a triangle
/// there may be an obstacle without edges; the last three corners are not points then.
struct FeaturePair {
  int count;                   // of the first feature's corners: 1, a point; 2, an edge
  std::array<int, 4> corners;  // points of the skins: those of the first feature, then those of the second
  std::size_t first;           // the side that the first feature is of, 0 or 1; the second is of the other

  [[nodiscard]] std::size_t side(int corner) const { return corner < count ? first : 1 - first; }
};

/// One that may meet in the step to come.
struct AwakePair {
  static constexpr std::size_t kNoBody = std::size_t(-1);

  FeaturePair pair;
  std::array<std::size_t, 2> bodies;     // by side; kNoBody: an obstacle without edges
  Vec3 normal;                           // unit, from the second feature's nearest place to the first's
  double gap;                            // m; negative: the point lies inside, and the normal leads out
  Eigen::Vector4d weights;               // see FeatureDistance
  Vec3 obstacle_velocity{Vec3::Zero()};  // m/s, there, of one without edges
  double friction = 0;                   // Coulomb's coefficient
  double restitution = 0;
  bool may_hold = true;     // not where another pair holds the same point better
  Vec3* impulse = nullptr;  // N s, on the first feature, of the last step; kept with the pair while it is near
  bool is_loaded = false;   // when measured: whether that impulse was not zero

  [[nodiscard]] std::size_t body_of(int corner) const { return bodies[pair.side(corner)]; }
};

/// Of what is between two features, that they may come closer in a step, beside a floor in bricks.
inline constexpr double kFreeShare = 0.8;
inline constexpr double kLeastGap = 1e-5;

/// Bricks that are left between surfaces that rest on each other where they are guarded, so that most pairs sleep; and
/// between edges, which act only where points do not hold.
inline constexpr double kGuardedGap = 0.03;
inline constexpr double kGuardedEdges = 0.6 * kGuardedGap;

/// By how much (m) two features may come closer before they have to be looked at: they may then have crossed in a step,
/// or have come to where contacts begin to hold them, `reach` (m) apart. `brick` in m.
[[nodiscard]] inline double way_until_due(double gap, double reach, double brick) {
  return std::min(kFreeShare * (gap - kLeastGap * brick), gap - reach);
}

}  // namespace sprung
