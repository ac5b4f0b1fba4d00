#pragma once
#include "app/recording.h"
#include "core/io/cache.h"

namespace sprung {

/// The production that a cache was made of, for what draws or measures it: nothing in it can be moved on, since
/// contacts, pins and damping are not in a cache.
[[nodiscard]] Production cached_production(const CacheHeader& header, const Scene& scene);

/// Its frames, and what the probes saw in them; which of those are of pins is not in a cache.
[[nodiscard]] Recording cached_recording(const CacheReader& cache);

/// One frame of it, by actor.
[[nodiscard]] std::vector<Floats3> cached_nodes(const CacheReader& cache, std::size_t frame);

}  // namespace sprung
