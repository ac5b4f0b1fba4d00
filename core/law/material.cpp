#include "core/law/material.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/error.h"

namespace sprung {
namespace {

[[noreturn]] void refuse(const Material& material, std::string_view quantity, double value, std::string_view range) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("material '{}': {} is {:g}, it must be {}", material.name, quantity, value, range));
}

}  // namespace

Material Material::in_motion() const {
  Material material = *this;
  material.poisson = poisson_in_motion.value_or(poisson);
  return material;
}

void check_material(const Material& material) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!is_positive(material.young)) refuse(material, "Young's modulus (Pa)", material.young, "above 0");
  for (const double poisson : {material.poisson, material.in_motion().poisson}) {
    if (!(poisson > -1 && poisson < 0.5)) refuse(material, "Poisson's ratio", poisson, "above -1 and below 0.5");
  }
  if (!is_positive(material.density)) refuse(material, "the density (kg/m3)", material.density, "above 0");
  if (!(material.damping >= 0 && std::isfinite(material.damping))) {
    refuse(material, "the damping ratio", material.damping, "0 or above");
  }
  const std::string fault = find_fault(material.law);
  if (!fault.empty()) throw Error(ErrorKind::kBadInput, fmt::format("material '{}': {}", material.name, fault));
}

}  // namespace sprung
