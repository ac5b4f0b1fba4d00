#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace sprung {

/// The light around vertices, as the shaders expect it: square roots of the irradiance over pi, less the key light,
/// over the brightest; and the fraction of the cosine-weighted hemisphere that no body occludes. 65535 is 1.
using VertexLight = Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// The light that comes through a translucent body to its vertices: square roots of the irradiance over pi where inward
/// rays leave the body, over the brightest, weighted by the fraction of light that travels half the distance
/// unscattered; and the mean of that fraction. Of metals: the light of other skins that they mirror, and the fraction
/// of their mirror that shows any. 0 for other bodies.
using ThroughLight = VertexLight;

inline constexpr float kBrightestVertexLight = 4;

}  // namespace sprung
