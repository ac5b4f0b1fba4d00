#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/scene/material_library.h"

namespace sprung {

/// What `sprung materials` was asked to do, as it was typed.
struct MaterialsOptions {
  std::vector<std::string> words;  // each has to be in a material's name or class
  std::string material_class;
  std::string young;               // "1kPa:2MPa"; either end may be left out
  std::vector<std::string> files;  // of further materials
  bool sources = false;
  bool json = false;
};

/// The materials that were asked for: a table, a line each; with their sources; or JSON, SI units.
/// Throws Error(kUsage) where the words make no sense, Error(kBadInput) for a file.
[[nodiscard]] std::string list_materials(const MaterialsOptions& options);

}  // namespace sprung
