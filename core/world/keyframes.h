#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// How a thing gets from one keyframe to the next.
enum class Interpolation {
  kLinear,
  kSmooth,  // at rest at the first and the last keyframe and where it turns back, and never beyond its keyframes
  kHeld     // jumps at each keyframe
};

/// Where a thing is at a time, seen from where it is put.
struct Keyframe {
  double time = 0;                // s
  Vec3 translate = Vec3::Zero();  // m
  Vec3 rotate = Vec3::Zero();     // degrees about x, then y, then z; more than a turn is as many turns
  double scale = 1;
};

/// Takes places x to centre + shift + scale rotation (x - centre).
struct Placement {
  Vec3 shift = Vec3::Zero();  // m
  Mat3 rotation = Mat3::Identity();
  double scale = 1;

  /// How far it takes a place that is `arm` away from the centre, m. Exactly zero for the placement of the start.
  [[nodiscard]] Vec3 way(const Vec3& arm) const { return scale * (rotation * arm) - arm + shift; }
};

/// How a placement changes. A place that it has taken to centre + shift + arm has the velocity
/// shift + growth arm + spin x arm.
struct PlacementRate {
  Vec3 shift = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();   // rad/s, axes of the world
  double growth = 0;          // 1/s, relative

  [[nodiscard]] Vec3 velocity(const Vec3& arm) const { return shift + growth * arm + spin.cross(arm); }
};

/// A path through keyframes. At t = 0 a thing is where it is put unless a keyframe says otherwise; after the last
/// keyframe it stays. Angles, shift and scale are interpolated each by itself; smoothly by cubics with the slopes of
/// Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984), which do not overshoot.
class Movement {
 public:
  Movement() = default;  // stays

  /// Precondition: times that grow from keyframe to keyframe, scales above 0.
  Movement(std::vector<Keyframe> keyframes, Interpolation interpolation);

  [[nodiscard]] Placement placement(double time) const;

  /// At a keyframe, where a linear path has a corner, that of the way on. Zero for kHeld.
  [[nodiscard]] PlacementRate rate(double time) const;

  /// Shift (m) and angles (rad) as they are, without a rotation made of them: what small displacements need.
  [[nodiscard]] PlacementRate small_placement(double time) const;

  [[nodiscard]] bool is_still() const;
  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }

 private:
  using Values = Eigen::Matrix<double, 7, 1>;  // shift (m), angles (rad), scale

  /// Values, and what they change by in a second.
  struct Point {
    Values values;
    Values rates;
  };
  [[nodiscard]] Point at(double time) const;
  [[nodiscard]] static Values values_of(const Keyframe& keyframe);
  void find_slopes();

  Interpolation interpolation_ = Interpolation::kLinear;
  std::vector<Keyframe> keyframes_;
  std::vector<Values> values_;  // by keyframe
  std::vector<Values> slopes_;  // by keyframe, of kSmooth
};

}  // namespace sprung
