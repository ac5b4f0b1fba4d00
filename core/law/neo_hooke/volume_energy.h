#pragma once

namespace sprung {

/// The volume ratio below which the logarithm of NeoHooke continues as a parabola.
inline constexpr double kLowestVolume = 0.1;

/// The part of psi that depends on the volume ratio, J/m^3, for Lame's constants in Pa.
[[nodiscard]] double volume_energy(double shear, double lambda, double ratio);

}  // namespace sprung
