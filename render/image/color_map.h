#pragma once
#include <Eigen/Core>

namespace sprung {

/// Perceptually even colour maps. Viridis and cividis rise from dark to light and suit colour-blind viewers; coolwarm
/// is blue below and red above a pale middle; ember likewise with a grey middle, which keeps thin objects visible on a
/// light floor; turbo is a rainbow without the false edges of older ones.
enum class ColorMap { kViridis, kCividis, kCoolwarm, kEmber, kTurbo };

/// sRGB in [0, 1] for a coordinate from 0 to 1 (clamped). Sources: viridis and cividis of matplotlib (CC0) by linear
/// interpolation of nine colours; coolwarm of Moreland, "Diverging Color Maps for Scientific Visualization" (2009), of
/// seventeen; ember from (65, -6, -48) by (34, 0, -3) to (65, 48, 56) in CIELAB, of nine; turbo by the polynomials of
/// Mikhailov and Donaghey (2019), without its nearly black ends, which a body at rest would have.
[[nodiscard]] Eigen::Vector3f map_color(ColorMap map, double coordinate);

}  // namespace sprung
