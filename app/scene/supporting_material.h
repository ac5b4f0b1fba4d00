#pragma once
#include <optional>

#include "app/scene/film.h"
#include "app/scene/standing_body.h"
#include "core/simulation/observer.h"

namespace sprung {

/// The result of a search for the softest gelatin, silicone or rubber of a library in which a body keeps its shape.
struct SupportingMaterial {
  const LibraryMaterial* material = nullptr;
  double size = 0;  // m, longest side of the body: smaller than requested if no material supports it at that size
  double sag = 0;   // largest displacement of a node under its own weight over the size
  int bricks = 0;   // along the longest side: kDefaultBricks, or fewer so that a film takes seconds
};

/// A body keeps its shape if it does so in its orientation and with its support (StandingBody::carried_displacement())
/// and its largest displacement under `gravity` (m/s^2) is at most 4 % of the size. At equal Poisson's ratio, shapes
/// depend on rho g L / E alone; so one coarse grid of 16 bricks or fewer serves all materials and sizes, and a search
/// that begins with what carries the body by the linear solution finds the heaviest load that is supported.
/// `may_shrink`: whether the size (m) may be halved up to four times. None if nothing supports it. Throws
/// Error(kBadInput) for a bad mesh.
[[nodiscard]] std::optional<SupportingMaterial> softest_supporting(const SceneBody& body, Support support,
                                                                   const Vec3& gravity, bool may_shrink,
                                                                   const MaterialLibrary& library,
                                                                   const Observer& observer);

/// Gives the bodies of kAutoMaterial the softest material that supports them at their size, fixed at their pins if they
/// have any, else standing; those that none supports, that have regions of other materials, or that nothing pulls down,
/// get kDefaultMaterial. The choice is reported to the observer. Throws like softest_supporting().
void choose_materials(Film& film, const Observer& observer);

}  // namespace sprung
