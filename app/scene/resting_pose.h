#pragma once
#include "core/mesh/surface_mesh.h"
#include "core/types.h"

namespace sprung {

/// The centre of the volume that a surface encloses; if it encloses none, of its area.
[[nodiscard]] Vec3 centre_of_mass(const SurfaceMesh& mesh);

/// The smallest rotation that brings a rigid body on level ground to the pose into which it would roll, over barriers
/// that are less than 15 degrees wide: its centre of mass then rises however it is tilted. The identity if that is
/// hardly lower than its present pose. `points` (n x 3): its surface; y is up. Deterministic. Cost: linear in the
/// points up to 20 000, beyond which they are thinned out.
[[nodiscard]] Mat3 rolled_to_rest(const Points& points, const Vec3& centre_of_mass);

/// How much its centre of mass has to rise before a rigid body on level ground tips over, in the units of the points; 0
/// if it needs no rise.
[[nodiscard]] double tipping_rise(const Points& points, const Vec3& centre_of_mass);

}  // namespace sprung
