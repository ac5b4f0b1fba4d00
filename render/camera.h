#pragma once
#include "core/types.h"

namespace sprung {

/// A pinhole camera. World: right-handed, y up, metres.
struct Camera {
  Vec3 eye{0, 0, 1};
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitY();
  double vertical_field_of_view = 30;  // degrees
  bool orthographic = false;           // parallel lines of sight, as wide as the others at the target
  double shift = 0;                    // of the picture to the right, in half widths
};

/// A camera that sees all of the points (n x 3, m; n >= 1) with a margin at the given width / height, as near as it can
/// be, from azimuth (degrees about y, 0 looks along -z) and elevation (degrees above the horizon).
[[nodiscard]] Camera frame_points(const Points& points, double aspect, double azimuth = 30, double elevation = 14,
                                  bool orthographic = false);

/// The camera carried around the vertical axis through `center` by that many degrees.
[[nodiscard]] Camera carried_around(const Camera& camera, const Vec3& center, double degrees);

/// A camera that sees all of `bounds` in the same way, and a rim of floor around it, where the shadow falls.
[[nodiscard]] Camera frame_bounds(const AlignedBox& bounds, double aspect, double azimuth = 30, double elevation = 14);

}  // namespace sprung
