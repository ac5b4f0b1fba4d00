#pragma once
#include <algorithm>

#include "core/types.h"

namespace sprung {

/// Coulomb's friction of a pressed point as an energy, smooth where it sticks: it grows with the square of the way up
/// to `slip`, in proportion beyond (Li et al., "Incremental Potential Contact", 2020).
class Grip {
 public:
  /// `moved` (m) since the step began, of which only what lies across the unit `normal` counts; `most` (N): coefficient
  /// times normal force; `slip` (m): that a point may creep before it slides.
  Grip(const Vec3& moved, const Vec3& normal, double most, double slip)
      : way_(moved - normal.dot(moved) * normal), normal_(normal), length_(way_.norm()), most_(most), slip_(slip) {}

  /// J.
  [[nodiscard]] double energy() const {
    return most_ * (length_ < slip_ ? 0.5 * length_ * length_ / slip_ : length_ - 0.5 * slip_);
  }
  /// What holds the point back, N.
  [[nodiscard]] Vec3 force() const { return -pull() * way_; }
  /// Of that force, N/m: symmetric, no negative eigenvalue.
  [[nodiscard]] Mat3 stiffness() const {
    Mat3 along = Mat3::Identity() - normal_ * normal_.transpose();
    if (length_ > slip_) along -= way_ * way_.transpose() / (length_ * length_);
    return pull() * along;
  }

 private:
  [[nodiscard]] double pull() const { return most_ / std::max(slip_, length_); }  // N/m

  Vec3 way_;
  Vec3 normal_;
  double length_;
  double most_;
  double slip_;
};

}  // namespace sprung
