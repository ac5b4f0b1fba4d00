#pragma once
#include "core/types.h"

namespace sprung {

/// The rotation about x, then y, then z (axes of the world), by degrees.
[[nodiscard]] Mat3 rotation_matrix(const Vec3& degrees);

}  // namespace sprung
