#pragma once
#include "core/law/solid/strain_energy.h"

namespace sprung {

/// A solid stretched along one axis, its sides free.
struct UniaxialState {
  double sideways = 1;  // stretch of the two other axes (length over rest length)
  double stress = 0;    // nominal: force over the area at rest, Pa
};

/// The state at a stretch above 0. Sides that no stretch leaves free (the linear law beyond s^2 = 1 + 1/nu) are NaN,
/// the stress too.
[[nodiscard]] UniaxialState uniaxial_state(const StrainEnergy& psi, double stretch);

}  // namespace sprung
