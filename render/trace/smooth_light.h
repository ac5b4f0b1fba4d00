#pragma once
#include <vector>

#include "render/trace/traced_light.h"

namespace sprung {

/// Averages light with that of neighbouring pixels, as far as surface and light are similar: an a-trous filter after
/// H. Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering" (2010), guided
/// by normals, positions, paint and, as in C. Schied et al., "Spatiotemporal Variance-Guided Filtering" (2017), by the
/// variance of the light. Consumes normals and positions.
void smooth(TracedLight& traced);

/// Linear light times opacity, and opacity, by pixel. If it `is_transparent`, skins only.
[[nodiscard]] std::vector<Eigen::Vector4f> composed(const TracedLight& traced, bool is_transparent);

}  // namespace sprung
