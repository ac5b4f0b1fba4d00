#pragma once
#include <nlohmann/json.hpp>

#include "core/simulation/crossings.h"

namespace sprung {

/// "frame" (from 1, as pictures are counted), "time_s", "crossing_pairs", "crossing_pairs_at_start", "depth_m",
/// "depth_percent" (of the largest body's size), and, if any cross, "between" and "place_m".
[[nodiscard]] nlohmann::ordered_json json_of(const Crossings& crossings);

/// An array of those.
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<Crossings>& frames);

}  // namespace sprung
