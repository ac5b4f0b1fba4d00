#pragma once
#include <nlohmann/json.hpp>

#include "core/law/material.h"

namespace sprung {

/// SI units.
[[nodiscard]] inline nlohmann::ordered_json json_of(const Material& material) {
  return {{"name", material.name},
          {"young", material.young},
          {"poisson", material.poisson},
          {"density", material.density},
          {"damping", material.damping}};
}

}  // namespace sprung
