#pragma once
#include <array>

#include "core/law/material.h"
#include "core/law/strain_energy_law.h"

namespace sprung {

/// The volume ratio below which log J of a StrainEnergy continues as a cubic, see volume_energy().
inline constexpr double kLowestVolume = 0.08;
/// By how many times its curvature there the curvature has grown at J = 0, below which it is constant.
inline constexpr double kCollapseStiffening = 100;
/// The principal stretch below which the terms of Ogden continue with the slope they have there.
inline constexpr double kLowestStretch = 0.1;
/// The exponent beyond which the exponential of Fung continues as a parabola: the solid is 400 times as stiff there.
inline constexpr double kLargestExponent = 6;

/// (exp(a W) - 1) / a, continued as StrainEnergy says, and its derivatives by W.
struct Stiffening {
  double energy;
  double slope;
  double curvature;

  Stiffening(double per_energy, double plain);
};

/// psi of a material with numbers for its law, all moduli in Pa (or what they are multiplied by): of log J as well as
/// of I1, I2 and the principal stretches.
struct HyperelasticTerms {
  StrainEnergyKind kind = StrainEnergyKind::kNeoHooke;
  double shear = 0;          // G
  double lambda = 0;         // lambda
  double log_volume = 0;     // psi contains minus this times log J, that of kFung in its exponent
  double square_volume = 0;  // and half of this times (J - 1)^2
  double by_i1 = 0;          // kMooneyRivlin: d psi / d I1
  double by_i2 = 0;          // likewise of I2
  double exponent = 0;       // b of kFung

  /// s^alpha_p, kOgden: psi contains f(s_1) + f(s_2) + f(s_3), d f / d (s^2) = sum over p: slope (s^2)^power.
  struct Term {
    double power = 0;   // alpha_p / 2 - 1
    double slope = 0;   // G w_p / alpha_p
    double energy = 0;  // 2 G w_p / alpha_p^2
  };
  std::array<Term, kMaxOgdenTerms> ogden{};  // those beyond the last are zero
};

/// All moduli times `factor`.
[[nodiscard]] HyperelasticTerms hyperelastic_terms(const Material& material, double factor = 1);

/// The part of psi that depends on the volume ratio alone, -log_volume log J + square_volume/2 (J - 1)^2, continued as
/// StrainEnergy says, J/m^3 for moduli in Pa.
[[nodiscard]] double volume_energy(double log_volume, double square_volume, double ratio);

}  // namespace sprung
