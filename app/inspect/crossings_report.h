#pragma once
#include <string>
#include <vector>

#include "app/scene/film.h"
#include "core/simulation/cache.h"
#include "core/simulation/crossings.h"
#include "core/simulation/simulation.h"
#include "render/image/image.h"

namespace sprung {

/// Where the skins of a recorded motion cross.
struct CrossingsReport {
  std::vector<Crossings> frames;  // but the first, which is the start
  Image picture;                  // of the deepest place; empty: none was asked for, or nothing crosses
};

/// Of all frames of a cache; with `draws`, with a picture: the whole frame on the left, the place from near on the
/// right; triangles of bodies that cross are red, the place is a black ball. Throws Error(kBadInput) where the cache
/// holds no motion, Error(kFailed) where no picture can be drawn.
[[nodiscard]] CrossingsReport find_crossings(const CacheReader& cache, bool draws, const Observer& observer);

/// A table of the frames in which skins cross, and a line about the deepest place.
[[nodiscard]] std::string text_of(const std::vector<Crossings>& frames);

}  // namespace sprung
