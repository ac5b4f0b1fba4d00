#pragma once
#include "core/types.h"

namespace sprung {

/// The impulse limited to Coulomb's cone: its tangential part is at most the coefficient times its normal part.
[[nodiscard]] Vec3 within_friction_cone(const Vec3& impulse, const Vec3& normal, double friction);

/// m/s^2: penetrations are resolved without gravity as well.
inline constexpr double kMinGravity = 0.1;
/// The least share of a contact's weights on free nodes: with less it cannot be moved.
inline constexpr double kMinFree = 0.05;

/// The least speed of a point along the normal, relative to the other surface, m/s: in a step it may approach until it
/// touches. A point inside (gap < 0, m) is moved out within about twenty steps, but no faster than a throw that would
/// just reach the surface: what starts a little too deep is lifted, not ejected. `gravity` in m/s^2, its magnitude.
[[nodiscard]] double min_speed(double gap, double gravity, double dt);

}  // namespace sprung
