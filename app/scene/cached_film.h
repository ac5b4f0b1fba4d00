#pragma once
#include "app/scene/film.h"
#include "core/simulation/run_cache.h"

namespace sprung {

/// The record of a film in a cache. It matches films that differ in camera and pictures only, or in a duration on which
/// no frame depends.
[[nodiscard]] SceneRecord record_of(const Film& film);

/// The film recorded in a cache. The files that it names need not exist.
[[nodiscard]] Film cached_film(const CacheHeader& header);

}  // namespace sprung
