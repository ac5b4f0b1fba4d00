#pragma once
#include <nlohmann/json.hpp>

#include "core/law/material.h"

namespace sprung {

/// "name", "young_Pa", "poisson", "density_kg_m3".
[[nodiscard]] inline nlohmann::ordered_json json_of(const Material& material) {
  return {{"name", material.name},
          {"young_Pa", material.young},
          {"poisson", material.poisson},
          {"density_kg_m3", material.density}};
}

}  // namespace sprung
