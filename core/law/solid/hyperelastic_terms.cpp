#include "core/law/solid/hyperelastic_terms.h"

#include <algorithm>
#include <cmath>

namespace sprung {

HyperelasticTerms hyperelastic_terms(const Material& material, double factor) {
  const StrainEnergyLaw& law = material.law;
  HyperelasticTerms terms;
  terms.kind = law.kind;
  const double shear = terms.shear = factor * material.shear_modulus();
  terms.lambda = terms.square_volume = factor * material.lame_lambda();
  switch (law.kind) {
    case StrainEnergyKind::kNeoHooke:
      terms.log_volume = shear;
      break;
    case StrainEnergyKind::kMooneyRivlin: {
      const double share = law.mooney_share.value();
      terms.by_i1 = 0.5 * shear * (1 - share);
      terms.by_i2 = 0.5 * shear * share;
      terms.log_volume = shear * (1 + share);
      terms.square_volume -= 2 * share * shear;
      break;
    }
    case StrainEnergyKind::kOgden:
      for (std::size_t p = 0; p < law.ogden_exponents.size(); ++p) {
        const double alpha = law.ogden_exponents[p];
        const double own = shear * (law.ogden_shares.empty() ? 1.0 : law.ogden_shares[p]);
        terms.ogden[p] = {.power = 0.5 * alpha - 1, .slope = own / alpha, .energy = 2 * own / (alpha * alpha)};
        terms.log_volume += 2 * own / alpha;
      }
      break;
    case StrainEnergyKind::kFung:
      terms.log_volume = shear;
      terms.exponent = law.fung_exponent.value();
      break;
    case StrainEnergyKind::kLinear:
      terms.square_volume = 0;
      break;
  }
  return terms;
}

Stiffening::Stiffening(double per_energy, double plain) {
  const double beyond = std::max(per_energy * plain - kLargestExponent, 0.0);
  const double power = std::exp(std::min(per_energy * plain, kLargestExponent));
  energy = (power * (1 + beyond + 0.5 * beyond * beyond) - 1) / per_energy;
  slope = power * (1 + beyond);
  curvature = per_energy * power;
}

double volume_energy(double log_volume, double square_volume, double ratio) {
  const double at = std::max(ratio, kLowestVolume);
  const double below = std::max(1 - ratio / kLowestVolume, 0.0);
  const double partly = std::min(below, 1.0);
  const double cubic = kCollapseStiffening / 2 * partly * (below * (below - partly) + partly * partly / 3);
  const double square = (ratio - 1) * (ratio - 1);
  return -log_volume * (std::log(at) - below - 0.5 * below * below - cubic) +
         0.5 * square_volume * (square_volume < 0 ? square / (1 + square) : square);
}

}  // namespace sprung
