#pragma once
#include <optional>

#include "app/scene/film.h"
#include "core/simulation/observer.h"

namespace sprung {

/// The softest gelatin, silicone or rubber of a library in which a body keeps its shape, and what was found.
struct CarryingMaterial {
  const LibraryMaterial* material = nullptr;
  double size = 0;  // m, longest side of the body: smaller than asked for where no material carries it at that size
  double sag = 0;   // largest displacement of a node under its own weight over the size
  int bricks = 0;   // along the longest side: kDefaultBricks, or fewer where these would be over 2500 in all
};

/// What carries a body.
enum class Support {
  kStands,  // its lowest 8 % are held
  kHangs,   // its highest
  kPins     // what its pins hold
};

/// A body keeps its shape where, as it is turned and carried, the largest displacement in its nonlinear equilibrium
/// under `gravity` (m/s^2) is at most 4 % of the size, its centre of mass keeps 60 % of its way to the edge of its
/// feet, so that it does not fall, and twice the weight displaces it by at most three times as much, so that it does
/// not buckle. Shapes scale: by rho g L / E alone, at equal Poisson's ratio; so one coarse fill of 16 bricks or less
/// serves all materials and sizes, among which the heaviest that is carried is found by bisection. `may_shrink`:
/// whether the size (m) may be halved up to four times. None where nothing carries it. Throws Error(kBadInput) of the
/// mesh.
[[nodiscard]] std::optional<CarryingMaterial> softest_carrying(const SceneBody& body, Support support,
                                                               const Vec3& gravity, bool may_shrink,
                                                               const MaterialLibrary& library,
                                                               const Observer& observer);

/// Gives the bodies of kAutoMaterial the softest material that carries them at their size, where they are pinned by
/// their pins, else standing; those that none carries, that have regions of other materials, or that nothing pulls
/// down, get kDefaultMaterial. The observer hears of it. Throws like softest_carrying().
void choose_materials(Film& film, const Observer& observer);

}  // namespace sprung
