#include "core/world/loads.h"

#include <cmath>

namespace sprung {

/// By Hooke's law: the stresses of a brick held in its shape while its rest shape is that of the muscle.
MuscleTension tension_of(const Muscle& muscle, const Material& material) {
  const double widening = 1 / std::sqrt(1 - muscle.contraction) - 1;
  const double twice_shear = 2 * material.shear_modulus();
  const double lame = twice_shear * material.poisson / (1 - 2 * material.poisson);
  const double growth = 2 * widening - muscle.contraction;
  const double along = -(lame * growth - twice_shear * muscle.contraction);
  const double across = -(lame * growth + twice_shear * widening);
  MuscleTension tension;
  const Vec3 aside = muscle.direction.unitOrthogonal();
  tension.frame << muscle.direction, aside, muscle.direction.cross(aside);
  tension.stress = {along, across, across};
  return tension;
}

}  // namespace sprung
