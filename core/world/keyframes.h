#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// The interpolation between keyframes.
enum class Interpolation {
  kLinear,
  kSmooth,  // zero slope at the first and last keyframe and at reversals; never overshoots
  kHeld     // jumps at each keyframe
};

/// A placement at a time, relative to the initial one.
struct Keyframe {
  double time = 0;                // s
  Vec3 translate = Vec3::Zero();  // m
  Vec3 rotate = Vec3::Zero();     // degrees about x, then y, then z; may exceed a full turn
  double scale = 1;
};

/// Maps x to centre + shift + scale rotation (x - centre).
struct Placement {
  Vec3 shift = Vec3::Zero();  // m
  Mat3 rotation = Mat3::Identity();
  double scale = 1;

  /// The displacement of the point at `arm` from the centre, m. Exactly zero for the default placement.
  [[nodiscard]] Vec3 way(const Vec3& arm) const { return scale * (rotation * arm) - arm + shift; }
};

/// The rate of change of a placement. The point now at centre + shift + arm has the velocity shift + growth arm + spin
/// x arm.
struct PlacementRate {
  Vec3 shift = Vec3::Zero();  // m/s
  Vec3 spin = Vec3::Zero();   // rad/s, axes of the world
  double growth = 0;          // 1/s, relative

  [[nodiscard]] Vec3 velocity(const Vec3& arm) const { return shift + growth * arm + spin.cross(arm); }
};

/// A motion through keyframes. It starts with the identity at t = 0 unless a keyframe says otherwise, and stops at the
/// last keyframe. Angles, shift and scale are interpolated separately; smoothly by cubics with the slopes of Fritsch
/// and Butland (SIAM J. Sci. Stat. Comput. 5, 1984), which do not overshoot.
class Movement {
 public:
  Movement() = default;  // stays

  /// Preconditions: strictly ascending times, scales above 0.
  Movement(std::vector<Keyframe> keyframes, Interpolation interpolation);

  [[nodiscard]] Placement placement(double time) const;

  /// At a keyframe of a linear motion, the rate just after it. Zero for kHeld.
  [[nodiscard]] PlacementRate rate(double time) const;

  /// Shift (m), angles (rad) and growth to first order, for small displacements.
  [[nodiscard]] PlacementRate small_placement(double time) const;

  [[nodiscard]] bool is_still() const;
  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }

 private:
  using Values = Eigen::Matrix<double, 7, 1>;  // shift (m), angles (rad), scale

  /// Values and their rates per second.
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
