#pragma once
#include "core/mesh/surface_mesh.h"
#include "core/types.h"

namespace sprung {

/// The centre of the volume that a surface encloses; where it encloses none, of its area.
[[nodiscard]] Vec3 centre_of_mass(const SurfaceMesh& mesh);

/// Whether a rigid body stands where it is put down on level ground: tilted by 10 degrees in any direction, its centre
/// of mass does not come to lie lower. `points` (n x 3): its surface; y is up.
[[nodiscard]] bool stands(const Points& points, const Vec3& centre_of_mass);

/// The smallest rotation that brings a body that does not stand into the pose into which it would roll; the identity
/// for one that stands. Deterministic. Cost: linear in the points up to 20 000, of which more are thinned out.
[[nodiscard]] Mat3 rolled_to_rest(const Points& points, const Vec3& centre_of_mass);

}  // namespace sprung
