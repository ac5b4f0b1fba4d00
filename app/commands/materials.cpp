#include "app/commands/materials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/console/json_text.h"
#include "app/scene/scene_values.h"
#include "core/error.h"

namespace sprung {
namespace {

/// Pa.
struct Moduli {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();
};

Moduli parse_moduli(const std::string& text) {
  if (text.empty()) return {};
  const auto colon = text.find(':');
  if (colon == std::string::npos) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--young: '{}' is no range; write it as 1kPa:2MPa, :2MPa or 1kPa:", text));
  }
  Moduli moduli;
  try {
    if (colon > 0) moduli.low = parse_quantity(text.substr(0, colon), Dimension::kPressure);
    if (colon + 1 < text.size()) moduli.high = parse_quantity(text.substr(colon + 1), Dimension::kPressure);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--young: {}", error.what()));
  }
  if (moduli.low > moduli.high) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--young: '{}' begins above its end; write the smaller one first", text));
  }
  return moduli;
}

std::optional<MaterialClass> parse_class(const std::string& text) {
  if (text.empty()) return std::nullopt;
  MaterialClass one{};
  try {
    parse_value(text, {.name = "class", .help = ""}, one);
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("--class: {}", error.what()));
  }
  return one;
}

bool has_word(const LibraryMaterial& material, const std::string& word) {
  return material.name.find(word) != std::string::npos || name_of(material.material_class) == word;
}

std::vector<LibraryMaterial> asked_for(const MaterialsOptions& options, const MaterialLibrary& library) {
  const Moduli moduli = parse_moduli(options.young);
  const std::optional<MaterialClass> wanted = parse_class(options.material_class);
  std::vector<LibraryMaterial> found;
  for (const LibraryMaterial& material : library.materials()) {
    const auto is_in = [&](const std::string& word) { return has_word(material, word); };
    if (wanted && material.material_class != *wanted) continue;
    if (material.young < moduli.low || material.young > moduli.high) continue;
    if (std::all_of(options.words.begin(), options.words.end(), is_in)) found.push_back(material);
  }
  for (const std::string& word : options.words) {
    const auto is_in = [&](const LibraryMaterial& material) { return has_word(material, word); };
    const auto all = library.materials();
    if (std::none_of(all.begin(), all.end(), is_in)) static_cast<void>(library.find(word));  // names the nearest
  }
  return found;
}

/// "±20%"; nothing where it is not known.
std::string percent(double share) { return share > 0 ? fmt::format("±{:.0f}%", 100 * share) : ""; }

std::string row(const LibraryMaterial& material) {
  return fmt::format("{:<20}{:<10}{:>10}{:<7}{:>9}{:>13}{:>9}  {}\n", material.name, name_of(material.material_class),
                     readable(material.young, Dimension::kPressure), percent(material.young_uncertainty),
                     material.poisson, with_unit(material.density, Dimension::kDensity), material.damping,
                     name_of(material.look));
}

std::string source_line(std::string_view what, const std::string& value, const std::string& uncertainty,
                        const std::string& source) {
  return fmt::format("    {:<9}{}{}{}{}\n", what, value, uncertainty.empty() ? "" : " " + uncertainty,
                     source.empty() ? "" : ": ", source);
}

std::string sources(const LibraryMaterial& material) {
  const std::string ratio = material.poisson_uncertainty > 0 ? fmt::format("±{}", material.poisson_uncertainty) : "";
  return (material.about.empty() ? "" : fmt::format("    {}\n", material.about)) +
         source_line("young", readable(material.young, Dimension::kPressure), percent(material.young_uncertainty),
                     material.young_source) +
         source_line("poisson", fmt::format("{}", material.poisson), ratio, material.poisson_source) +
         source_line("density", with_unit(material.density, Dimension::kDensity), percent(material.density_uncertainty),
                     material.density_source) +
         source_line("damping", fmt::format("{}", material.damping), percent(material.damping_uncertainty),
                     material.damping_source);
}

std::string json(const LibraryMaterial& material) {
  const auto figure = [](std::string_view name, double value, double uncertainty, const std::string& source) {
    return fmt::format(R"("{}": {{"value": {}, "uncertainty": {}, "source": {}}})", name, json_text(value),
                       json_text(uncertainty), json_text(std::string_view(source)));
  };
  const std::vector<std::string> members{
      fmt::format(R"("name": {})", json_text(std::string_view(material.name))),
      fmt::format(R"("class": {})", json_text(name_of(material.material_class))),
      fmt::format(R"("about": {})", json_text(std::string_view(material.about))),
      figure("young", material.young, material.young * material.young_uncertainty, material.young_source),
      figure("poisson", material.poisson, material.poisson_uncertainty, material.poisson_source),
      figure("density", material.density, material.density * material.density_uncertainty, material.density_source),
      figure("damping", material.damping, material.damping * material.damping_uncertainty, material.damping_source),
      fmt::format(R"("look": {})", json_text(name_of(material.look)))};
  return fmt::format("  {{{}}}", fmt::join(members, ", "));
}

}  // namespace

std::string list_materials(const MaterialsOptions& options) {
  MaterialLibrary library = *built_in_materials();
  for (const std::string& file : options.files) library.add_file(file);
  const std::vector<LibraryMaterial> materials = asked_for(options, library);
  if (options.json) {
    std::vector<std::string> objects;
    objects.reserve(materials.size());
    for (const LibraryMaterial& material : materials) objects.push_back(json(material));
    return fmt::format("[\n{}\n]\n", fmt::join(objects, ",\n"));
  }
  std::string text = fmt::format("{:<20}{:<10}{:>10}{:<7}{:>9}{:>13}{:>9}  {}\n", "name", "class", "young", "",
                                 "poisson", "density", "damping", "look");
  for (const LibraryMaterial& material : materials) text += row(material) + (options.sources ? sources(material) : "");
  return text;
}

}  // namespace sprung
