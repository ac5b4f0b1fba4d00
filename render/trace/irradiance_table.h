#pragma once
#include <Eigen/Core>
#include <vector>

#include "render/trace/stage_light.h"

namespace sprung {

/// Irradiance over pi of unoccluded surfaces, from all surrounding light but the key light.
class IrradianceTable {
 public:
  explicit IrradianceTable(const StageLight& light);
  /// `normal`: unit. Within 1 %.
  [[nodiscard]] Eigen::Vector3f on(const Eigen::Vector3f& normal) const;

 private:
  std::vector<Eigen::Vector3f> values_;  // by elevation and turn, at equal steps
};

}  // namespace sprung
