#pragma once
#include <optional>

#include "app/scene/material_library.h"
#include "core/simulation/observer.h"
#include "core/simulation/scene.h"

namespace sprung {

/// The softest gelatin, silicone or rubber of a library in which a body keeps its shape, and what was found.
struct CarryingMaterial {
  const LibraryMaterial* material = nullptr;
  double size = 0;  // m, longest side of the body: smaller than asked for where no material carries it at that size
  double sag = 0;   // largest displacement of a node under its own weight over the size
};

/// A body keeps its shape where, held by `held` (in the frame of its mesh), the
/// largest displacement in its nonlinear equilibrium under `gravity` (m/s^2) is at most 4 % of the size, and twice the
/// weight displaces it by at most three times as much, so that it does not buckle. Shapes scale: by rho g L / E alone,
/// at equal Poisson's ratio; so one coarse fill of 16 bricks serves all materials and sizes.
/// `may_shrink`: whether the size (m) may be halved up to four times. None where `held` leaves the body free, or
/// nothing holds it. Throws Error(kBadInput) of the mesh.
[[nodiscard]] std::optional<CarryingMaterial> softest_carrying(const SceneBody& body, const Pin& held,
                                                               const Vec3& gravity, bool may_shrink,
                                                               const MaterialLibrary& library,
                                                               const Observer& observer);

}  // namespace sprung
