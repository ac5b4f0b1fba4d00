#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/scene/film.h"

namespace sprung {

struct NamedScene {
  std::string name;
  Film scene;
};

/// The scene files of the experiments that come with the program, by name.
/// Throws Error(kFailed) where their folder is not found.
[[nodiscard]] std::vector<std::filesystem::path> experiment_files();

/// The experiments of these names or files; all that come with the program where there are none.
/// Throws Error(kUsage) with the nearest name, Error(kBadInput) for a scene that expects nothing.
[[nodiscard]] std::vector<NamedScene> read_experiments(const std::vector<std::string>& cases);

}  // namespace sprung
