#pragma once
#include <string>
#include <vector>

#include "app/scene/film.h"
#include "core/simulation/cache.h"
#include "core/simulation/crossings.h"
#include "core/simulation/simulation.h"
#include "render/image/image.h"

namespace sprung {

/// The crossings of skins in a recorded motion.
struct CrossingsReport {
  std::vector<Crossings> frames;  // all but the first, which is the start
  Image picture;                  // of the deepest crossing; empty: not requested, or nothing crosses
};

/// Checks all frames of a cache; with `draws`, adds a picture: the whole frame on the left, a close-up of the crossing
/// on the right; triangles of bodies that cross are red, a black ball marks the crossing. Throws Error(kBadInput) if
/// the cache holds no motion, Error(kFailed) if no picture can be drawn.
[[nodiscard]] CrossingsReport find_crossings(const CacheReader& cache, bool draws, const Observer& observer);

/// A table of the frames in which skins cross, and a line about the deepest crossing.
[[nodiscard]] std::string text_of(const std::vector<Crossings>& frames);

}  // namespace sprung
