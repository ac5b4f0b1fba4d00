#include "render/trace/ground_light.h"

namespace sprung {

Eigen::Vector3f GroundLight::at(float x, float z) const {
  const Eigen::Array2f inside = float(size) * (Eigen::Array2f(x, z) - low.array()) / sides.array() - 0.5F;
  const Eigen::Array2f at = inside.max(0.0F).min(float(size - 1) - 1e-3F);
  const int column = int(at.x());
  const int row = int(at.y());
  const float across = at.x() - float(column);
  const float down = at.y() - float(row);
  const auto texel = [&](int i, int k) {
    return texels[std::size_t(row + k) * std::size_t(size) + std::size_t(column + i)];
  };
  return (1 - down) * ((1 - across) * texel(0, 0) + across * texel(1, 0)) +
         down * ((1 - across) * texel(0, 1) + across * texel(1, 1));
}

}  // namespace sprung
