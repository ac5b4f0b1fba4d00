#pragma once
#include "core/types.h"

namespace sprung {

/// A pinhole camera, or one with a lens that is focused on the target. World: right-handed, y up, metres.
struct Camera {
  Vec3 eye{0, 0, 1};
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3::UnitY();
  double vertical_field_of_view = 30;  // degrees
  bool orthographic = false;           // parallel projection, as wide as the perspective one is at the target
  double shift = 0;                    // of the picture to the right, in half widths of the picture
  double aperture = 0;                 // m, diameter of the lens; needs RenderOptions::exposes
};

/// The nearest camera that sees all of the points (n x 3, m; n >= 1) with a margin, in a picture of the given aspect
/// (width / height), from azimuth (degrees about y, 0 looks along -z) and elevation (degrees above the horizon).
[[nodiscard]] Camera frame_points(const Points& points, double aspect, double azimuth = 30, double elevation = 14,
                                  bool orthographic = false);

/// The camera rotated about the vertical axis through `center`.
[[nodiscard]] Camera carried_around(const Camera& camera, const Vec3& center, double degrees);

/// The same for all of `bounds` and the floor around it, where the shadow falls.
[[nodiscard]] Camera frame_bounds(const AlignedBox& bounds, double aspect, double azimuth = 30, double elevation = 14);

}  // namespace sprung
