#include "app/materials.h"

#include <fmt/format.h>

#include "app/units.h"
#include "core/law/material.h"

namespace sprung {

std::string materials_table() {
  std::string table =
      fmt::format("{:<14}{:>10}{:>9}{:>13}{:>9}  {}\n", "name", "young", "poisson", "density", "damping", "source");
  for (const Material& material : material_library()) {
    table += fmt::format("{:<14}{:>10}{:>9}{:>13}{:>9}  {}\n", material.name,
                         readable(material.young, Dimension::kPressure), material.poisson,
                         with_unit(material.density, Dimension::kDensity), material.damping, material.source);
  }
  return table;
}

}  // namespace sprung
