#include "render/stage/stage.h"

namespace sprung {

Lighting lighting_of(const Stage& stage) {
  Lighting lighting = stage.lighting;
  if (stage.environment) lighting.sky = stage.environment->irradiance_on(Eigen::Vector3f::UnitY());
  if (stage.floor.pattern) lighting.floor = stage.floor.pattern->mean;
  return lighting;
}

}  // namespace sprung
