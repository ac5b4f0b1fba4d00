#pragma once
#include "app/scene/film.h"
#include "core/simulation/run_cache.h"

namespace sprung {

/// The film as a cache keeps it. The duration of what it is compared with may differ where no frame depends on it;
/// camera and pictures may.
[[nodiscard]] SceneRecord record_of(const Film& film);

/// The film in a cache, wherever the files are that it names.
[[nodiscard]] Film cached_film(const CacheHeader& header);

}  // namespace sprung
