#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/material_figure.h"
#include "app/commands/options.h"
#include "app/scene/scene_values.h"
#include "core/color_text.h"
#include "core/error.h"
#include "core/files.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

/// The options as typed.
struct MaterialsOptions {
  std::vector<std::string> words;  // each has to be in a material's name or class
  std::string material_class;
  std::string young;               // "1kPa:2MPa"; either end may be left out
  std::vector<std::string> files;  // of further materials
  bool sources = false;
  bool json = false;
  std::string picture;  // file
};

constexpr std::size_t kMaxDrawn = 12;

void draw_materials(const std::vector<LibraryMaterial>& materials, const std::string& file) {
  if (lower_extension(file) != ".svg") {
    throw Error(ErrorKind::kUsage, fmt::format("--picture {}: it is written as .svg", file));
  }
  if (materials.empty() || materials.size() > kMaxDrawn) {
    throw Error(ErrorKind::kUsage, fmt::format("--picture draws 1 to {} materials, these are {}; name some of them",
                                               kMaxDrawn, materials.size()));
  }
  write_file(file, svg_text(material_figure(materials)));
}

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
                fmt::format("--young: '{}' is not a range; write it as 1kPa:2MPa, :2MPa or 1kPa:", text));
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

/// "±20%"; nothing if it is not known.
std::string percent(double share) { return share > 0 ? fmt::format("±{:.0f}%", 100 * share) : ""; }

/// "276 MPa"; a dash if there is none or it is not known.
std::string strength_text(double strength) { return strength > 0 ? readable(strength, Dimension::kPressure) : "-"; }

/// "17%"; a dash if it is not known.
std::string elongation_text(double strain) { return strain > 0 ? fmt::format("{:g}%", 100 * strain) : "-"; }

std::string row(const LibraryMaterial& material) {
  return fmt::format("{:<20}{:<10}{:>10}{:<7}{:>9}{:>13}{:>9}{:>10}{:>10}{:>12}  {}\n", material.name,
                     name_of(material.material_class), readable(material.young, Dimension::kPressure),
                     percent(material.young_uncertainty), material.poisson,
                     with_unit(material.density, Dimension::kDensity), material.damping,
                     strength_text(material.yield_strength), strength_text(material.ultimate_strength),
                     elongation_text(material.elongation), name_of(material.look));
}

std::string source_line(std::string_view what, const std::string& value, const std::string& uncertainty,
                        const std::string& source) {
  return fmt::format("    {:<12}{}{}{}{}\n", what, value, uncertainty.empty() ? "" : " " + uncertainty,
                     source.empty() ? "" : ": ", source);
}

std::string strength_sources(const LibraryMaterial& material) {
  std::string lines;
  if (material.yield_strength > 0) {
    lines += source_line("yield", strength_text(material.yield_strength), percent(material.yield_strength_uncertainty),
                         material.yield_strength_source);
  }
  if (material.ultimate_strength > 0) {
    lines += source_line("ultimate", strength_text(material.ultimate_strength),
                         percent(material.ultimate_strength_uncertainty), material.ultimate_strength_source);
  }
  if (material.elongation > 0) {
    lines += source_line("elongation", elongation_text(material.elongation), percent(material.elongation_uncertainty),
                         material.elongation_source);
  }
  return lines;
}

std::string sources(const LibraryMaterial& material) {
  const std::string ratio = material.poisson_uncertainty > 0 ? fmt::format("±{}", material.poisson_uncertainty) : "";
  return (material.about.empty() ? "" : fmt::format("    {}\n", material.about)) +
         source_line("young", readable(material.young, Dimension::kPressure), percent(material.young_uncertainty),
                     material.young_source) +
         source_line("poisson", fmt::format("{}", material.poisson), ratio, material.poisson_source) +
         (material.poisson_in_motion ? source_line("in motions", fmt::format("{}", *material.poisson_in_motion), "",
                                                   "less, since 0.499 takes 7 times the explicit steps of 0.45")
                                     : "") +
         source_line("density", with_unit(material.density, Dimension::kDensity), percent(material.density_uncertainty),
                     material.density_source) +
         source_line("damping", fmt::format("{}", material.damping), percent(material.damping_uncertainty),
                     material.damping_source) +
         strength_sources(material) +
         (material.law == StrainEnergyLaw{} ? ""
                                            : source_line("law", law_text(material.law), "", material.law_source)) +
         (material.color ? source_line("color", hex_text(*material.color), "", material.color_source) : "");
}

Json json_of(const LibraryMaterial& material) {
  const auto figure = [](double value, double uncertainty, const std::string& source) {
    return Json{{"value", value}, {"uncertainty", uncertainty}, {"source", source}};
  };
  const auto if_known = [&](double value, double relative, const std::string& source) {
    return value > 0 ? figure(value, value * relative, source) : Json();  // null: none, or not known
  };
  return {
      {"name", material.name},
      {"class", name_of(material.material_class)},
      {"about", material.about},
      {"young", figure(material.young, material.young * material.young_uncertainty, material.young_source)},
      {"poisson", figure(material.poisson, material.poisson_uncertainty, material.poisson_source)},
      {"poisson_in_motion", material.poisson_in_motion ? Json(*material.poisson_in_motion) : Json()},
      {"density", figure(material.density, material.density * material.density_uncertainty, material.density_source)},
      {"damping", figure(material.damping, material.damping * material.damping_uncertainty, material.damping_source)},
      {"yield_strength",
       if_known(material.yield_strength, material.yield_strength_uncertainty, material.yield_strength_source)},
      {"ultimate_strength",
       if_known(material.ultimate_strength, material.ultimate_strength_uncertainty, material.ultimate_strength_source)},
      {"elongation", if_known(material.elongation, material.elongation_uncertainty, material.elongation_source)},
      {"law", {{"value", law_text(material.law)}, {"source", material.law_source}}},
      {"look", name_of(material.look)},
      {"mean_free_path",
       if_known(material.mean_free_path, material.mean_free_path_uncertainty, material.mean_free_path_source)},
      {"color",
       material.color ? Json{{"value", hex_text(*material.color)}, {"source", material.color_source}} : Json()}};
}

void list_materials(const MaterialsOptions& options) {
  MaterialLibrary library = *built_in_materials();
  for (const std::string& file : options.files) library.add_file(file);
  const std::vector<LibraryMaterial> materials = asked_for(options, library);
  if (!options.picture.empty()) draw_materials(materials, options.picture);
  if (options.json) {
    Json list = Json::array();
    for (const LibraryMaterial& material : materials) list.push_back(json_of(material));
    fmt::print("{}\n", list.dump(1, ' ', false, Json::error_handler_t::replace));
    return;
  }
  fmt::print("{:<20}{:<10}{:>10}{:<7}{:>9}{:>13}{:>9}{:>10}{:>10}{:>12}  {}\n", "name", "class", "young", "", "poisson",
             "density", "damping", "yield", "ultimate", "elongation", "look");
  for (const LibraryMaterial& material : materials) {
    fmt::print("{}{}", row(material), options.sources ? sources(material) : "");
  }
}

}  // namespace

void add_materials(CLI::App& app, Invocation&) {
  CLI::App* command = app.add_subcommand("materials", "what bodies can be made of, with sources and uncertainties");
  const auto options = std::make_shared<MaterialsOptions>();
  command->add_option("WORDS", options->words, "these only: part of a name, or a class");
  command->add_option("--class", options->material_class, "these only: gelatin, silicone, rubber, foam, wood, ...")
      ->option_text("NAME");
  command->add_option("--young", options->young, "these only: Young's modulus from A to B")->option_text("A:B");
  command->add_option("--materials", options->files, "a file with materials of your own; may be given several times")
      ->allow_extra_args(false)
      ->option_text("FILE.toml");
  command->add_flag("--sources", options->sources, "the source of every value");
  command->add_option("--picture", options->picture, "draw their stress over stretch, with what was measured")
      ->option_text("FILE.svg");
  command->add_flag("--json", options->json, "as JSON, SI units, with the sources");
  command->footer(
      "Examples:\n  sprung materials\n  sprung materials silicone --young :1MPa\n"
      "  sprung materials steel --sources\n  sprung materials --materials mine.toml --json\n"
      "  sprung materials rubber --picture rubber.svg");
  command->callback([options] { list_materials(*options); });
}

}  // namespace sprung
