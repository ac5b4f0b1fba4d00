#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/appearance.h"
#include "core/law/material.h"

namespace sprung {

enum class MaterialClass { kGelatin, kSilicone, kRubber, kFoam, kWood, kTissue, kPlastic, kMetal, kOther };

/// A material with the sources and uncertainties of its values. SI units. An uncertainty is how much another specimen,
/// manufacturer or measurement may differ from the value here; 0 if unknown.
struct LibraryMaterial {
  std::string name;
  MaterialClass material_class = MaterialClass::kOther;
  std::string about;
  double young = 0;              // Pa
  double young_uncertainty = 0;  // relative
  std::string young_source;      // of the value
  double poisson = 0;
  double poisson_uncertainty = 0;  // of the ratio itself
  std::string poisson_source;
  std::optional<double> poisson_in_motion;
  double density = 0;              // kg/m^3
  double density_uncertainty = 0;  // relative
  std::string density_source;
  double damping = 0.02;           // ratio of critical damping
  double damping_uncertainty = 0;  // relative
  std::string damping_source;
  StrainEnergyLaw law;  // at large strains
  std::string law_source;
  std::filesystem::path curve;            // absolute; of a tension test that young and the law are fitted to, or empty
  double yield_strength = 0;              // Pa; beyond it deformation is permanent; 0: none, or not known
  double yield_strength_uncertainty = 0;  // relative
  std::string yield_strength_source;
  double ultimate_strength = 0;              // Pa; the greatest engineering stress in tension; 0: not known
  double ultimate_strength_uncertainty = 0;  // relative
  std::string ultimate_strength_source;
  double elongation = 0;              // strain at break, in tension; 0: not known
  double elongation_uncertainty = 0;  // relative
  std::string elongation_source;
  Look look = Look::kPlastic;
  double mean_free_path = 0;              // m; of light inside before it is scattered; 0: no light enters
  double mean_free_path_uncertainty = 0;  // relative
  std::string mean_free_path_source;
  std::optional<Color> color;  // of bodies that name none: what a metal reflects
  std::string color_source;

  /// The properties that the simulation needs.
  [[nodiscard]] Material material() const;
};

inline constexpr std::string_view kDefaultMaterial = "gelatin";
/// The material of a body that names none, until choose_materials() finds the softest that supports it.
inline constexpr std::string_view kAutoMaterial = "auto";

/// Materials by name: those built into the program, and those of the user's files.
class MaterialLibrary {
 public:
  MaterialLibrary() = default;

  /// Adds the materials of a TOML text read from (or standing for) a file. Throws one Error(kBadInput) with a line
  /// "file:line:column: key: what is wrong" for every mistake in it; a name that exists already is one.
  void add(std::string_view text, const std::filesystem::path& file);
  /// The same for a file.
  void add_file(const std::filesystem::path& file);

  [[nodiscard]] std::span<const LibraryMaterial> materials() const { return materials_; }
  /// The material of that name, else ignoring case ("ABS"); null if there is none.
  [[nodiscard]] const LibraryMaterial* find_if_known(std::string_view name) const;
  /// Throws Error(kBadInput) with the nearest name if there is none.
  [[nodiscard]] const LibraryMaterial& find(std::string_view name) const;
  /// The properties of the material that a scene names; for kAutoMaterial those of kDefaultMaterial. Throws like
  /// find().
  [[nodiscard]] Material named(std::string_view name) const;

 private:
  std::vector<LibraryMaterial> materials_;  // in the order added
};

/// assets/materials.toml as it was when the program was built.
[[nodiscard]] std::shared_ptr<const MaterialLibrary> built_in_materials();

}  // namespace sprung
