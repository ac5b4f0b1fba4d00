#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/law/strain_energy_law.h"

namespace sprung {

/// A homogeneous, isotropic elastic solid. SI units.
struct Material {
  std::string name = "custom";
  double young = 20e3;    // Young's modulus E, Pa, > 0
  double poisson = 0.45;  // Poisson's ratio nu, -1 < nu < 1/2
  double density = 1000;  // kg/m^3, > 0
  double damping = 0.02;  // ratio of critical damping at the body's slowest vibration (see rayleigh_from_damping)
  std::string source;     // where the figures come from
  /// Poisson's ratio in motions, if not `poisson`: explicit steps of 0.499 are a seventh of those of 0.45.
  std::optional<double> poisson_in_motion{};
  StrainEnergyLaw law{};          // how it goes on at large strains
  std::filesystem::path curve{};  // absolute; of a tension test that `young` and `law` are fitted to, or empty

  /// With the ratio of motions.
  [[nodiscard]] Material in_motion() const;
  [[nodiscard]] double shear_modulus() const { return young / (2 * (1 + poisson)); }                          // G, Pa
  [[nodiscard]] double lame_lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }  // Pa
};

/// Throws Error(kBadInput) naming the quantity, its value and its range.
void check_material(const Material& material);

}  // namespace sprung
