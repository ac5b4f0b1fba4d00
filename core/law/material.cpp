#include "core/law/material.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/nearest.h"

namespace sprung {
namespace {

/// Damping ratios are those usual for the kind of material; few sources give them together with the moduli.
const std::array<Material, 13>& library() {
  static const std::array<Material, 13> materials{{
      {"aluminium", 68.9e9, 0.33, 2700, 0.002, "6061-T6, ASM Handbook vol. 2 (1990)"},
      {"cork", 20e6, 0.05, 170, 0.05,
       "radial; Gibson, Easterling, Ashby, 'The structure and mechanics of cork', Proc. R. Soc. A 377 (1981)"},
      {"ecoflex", 69e3, 0.48, 1070, 0.05, "Ecoflex 00-30, 100 % modulus 10 psi: Smooth-On technical bulletin"},
      {"foam", 1e6, 0.27, 55, 0.1,
       "flexible polymer foam of low density: Ashby, 'Materials Selection in Mechanical Design', appendix A"},
      {"gelatin", 24e3, 0.45, 1050, 0.03,
       "6 % gelatin, G = 8.05 kPa: Nguyen et al., Ultrasound Med. Biol. 40 (2014); nu below the true 0.4999"},
      {"ldpe", 230e6, 0.38, 925, 0.03,
       "polyethylene of low density: Callister, 'Materials Science and Engineering', appendix B"},
      {"liver", 5.5e3, 0.45, 1060, 0.1, "healthy human liver: Roulot et al., J. Hepatol. 48 (2008)"},
      {"muscle", 12e3, 0.45, 1060, 0.1,
       "relaxed skeletal muscle: Engler et al., J. Cell Biol. 166 (2004); density: Mendez and Keys, Metabolism 9 "
       "(1960)"},
      {"rubber", 2e6, 0.49, 925, 0.03, "natural rubber: Ashby, 'Materials Selection in Mechanical Design', appendix A"},
      {"silicone", 1.14e6, 0.48, 1080, 0.04,
       "Shore A 30: Gent, Rubber Chem. Technol. 31 (1958); density: Dragon Skin 30, Smooth-On technical bulletin"},
      {"soft-gelatin", 6e3, 0.45, 1020, 0.03,
       "3 % gelatin, G = 2.01 kPa: Nguyen et al., Ultrasound Med. Biol. 40 (2014); nu below the true 0.4999"},
      {"steel", 210e9, 0.3, 7850, 0.002, "structural steel: EN 1993-1-1 section 3.2.6, EN 1991-1-1 annex A"},
      {"wood", 10.8e9, 0.37, 400, 0.01,
       "Sitka spruce along the grain, taken as isotropic: Wood Handbook, USDA FPL-GTR-282 (2021)"},
  }};
  return materials;
}

[[noreturn]] void refuse(const Material& material, std::string_view quantity, double value, std::string_view range) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("material '{}': {} is {:g}, it must be {}", material.name, quantity, value, range));
}

}  // namespace

std::span<const Material> material_library() { return library(); }

const Material& find_material(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Material& material : material_library()) {
    if (material.name == name) return material;
    names.push_back(material.name);
  }
  throw Error(ErrorKind::kBadInput, fmt::format("there is no material '{}'{}", name, did_you_mean(name, names)));
}

void check_material(const Material& material) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!is_positive(material.young)) refuse(material, "Young's modulus (Pa)", material.young, "above 0");
  if (!(material.poisson > -1 && material.poisson < 0.5)) {
    refuse(material, "Poisson's ratio", material.poisson, "above -1 and below 0.5");
  }
  if (!is_positive(material.density)) refuse(material, "the density (kg/m3)", material.density, "above 0");
  if (!(material.damping >= 0 && std::isfinite(material.damping))) {
    refuse(material, "the damping ratio", material.damping, "0 or above");
  }
}

}  // namespace sprung
