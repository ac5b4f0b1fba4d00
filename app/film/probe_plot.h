#pragma once
#include "app/recording.h"
#include "render/image/plot.h"

namespace sprung {

/// sRGB, of a probe's trace and curve, by its place among the probes.
[[nodiscard]] Eigen::Vector3f probe_color(std::size_t probe);

/// How far each probe is from where it was in the first frame, in a unit in which the numbers are short.
[[nodiscard]] Plot plot_of(const Recording& recording, std::size_t now);

}  // namespace sprung
