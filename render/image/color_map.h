#pragma once
#include <Eigen/Core>

namespace sprung {

/// Colours that stand for numbers, evenly spaced to the eye. Viridis and cividis rise from dark to light and are told
/// apart by colour-blind people; coolwarm is blue below and red above its pale middle, ember above its dark one, which
/// thin things need before a light floor; turbo is a rainbow without the false edges of the older ones.
enum class ColorMap { kViridis, kCividis, kCoolwarm, kEmber, kTurbo };

/// sRGB in [0, 1] for a share from 0 to 1 (clamped). Sources: viridis and cividis of matplotlib (CC0) by linear
/// interpolation of nine colours; coolwarm of Moreland, "Diverging Color Maps for Scientific Visualization" (2009), of
/// seventeen; ember from (65, -6, -48) by (34, 0, -3) to (65, 48, 56) in CIELAB, of nine; turbo by the polynomials of
/// Mikhailov and Donaghey (2019), without its ends, which are nearly black: a body at rest would be.
[[nodiscard]] Eigen::Vector3f map_color(ColorMap map, double share);

}  // namespace sprung
