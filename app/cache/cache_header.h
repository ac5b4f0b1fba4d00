#pragma once
#include <string>

#include "app/build_world.h"
#include "core/io/cache.h"

namespace sprung {

/// What of a production goes into a cache.
[[nodiscard]] CacheHeader cache_header(const Scene& scene, const Production& production, std::string progress_name);

/// Why frames of one run cannot go on as another: the first thing that differs, with both values; empty where nothing
/// does. The duration may differ where no frame depends on it; camera and pictures may.
[[nodiscard]] std::string difference(const CacheHeader& cached, const CacheHeader& now);

/// "to the last bit", "to within 1e-05 m".
[[nodiscard]] std::string position_accuracy(const CacheHeader& header);

/// The scene in a cache, wherever the files are that it names.
[[nodiscard]] Scene cached_scene(const CacheHeader& header);

}  // namespace sprung
