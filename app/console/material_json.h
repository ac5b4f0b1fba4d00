#pragma once
#include <nlohmann/json.hpp>

#include "core/law/material.h"

namespace sprung {

/// "name", "young_Pa", "poisson", "density_kg_m3", "law" and, where it has some, its parameters;
/// "poisson_in_motion" if it has one.
[[nodiscard]] inline nlohmann::ordered_json json_of(const Material& material) {
  nlohmann::ordered_json json{{"name", material.name},
                              {"young_Pa", material.young},
                              {"poisson", material.poisson},
                              {"density_kg_m3", material.density},
                              {"law", law_name(material.law.kind)}};
  if (material.poisson_in_motion) json["poisson_in_motion"] = *material.poisson_in_motion;
  const StrainEnergyLaw& law = material.law;
  if (law.mooney_share) json["mooney_share"] = *law.mooney_share;
  if (law.fung_exponent) json["fung_exponent"] = *law.fung_exponent;
  if (!law.ogden_exponents.empty()) json["ogden_exponents"] = law.ogden_exponents;
  if (!law.ogden_shares.empty()) json["ogden_shares"] = law.ogden_shares;
  return json;
}

}  // namespace sprung
