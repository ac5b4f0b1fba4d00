#include "app/validate/experiment_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// Where the program is installed its assets lie beside it, else in the source tree that it was built from.
fs::path experiment_folder() {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  const fs::path installed = program.parent_path().parent_path() / "share/sprung/experiments";
  for (const fs::path& folder : {installed, fs::path(SPRUNG_ASSETS) / "experiments"}) {
    if (fs::is_directory(folder, failure)) return folder;
  }
  throw Error(ErrorKind::kFailed, fmt::format("the experiments are not found in '{}'", installed.string()));
}

NamedScene read_experiment(const fs::path& file) {
  NamedScene experiment{.name = file.stem().string(), .scene = read_scene(file)};
  if (!experiment.scene.expectations.empty()) return experiment;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: the scene expects nothing; give it [[expect]] with quantity, value and source", file.string()));
}

fs::path file_of(const std::string& word, const std::vector<fs::path>& known) {
  if (is_scene_file(word)) return word;
  std::vector<std::string> names;
  for (const fs::path& file : known) {
    names.push_back(file.stem().string());
    if (names.back() == word) return file;
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw Error(ErrorKind::kUsage, fmt::format("there is no experiment '{}'{}; see sprung validate --list", word,
                                             did_you_mean(word, views)));
}

}  // namespace

std::vector<fs::path> experiment_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(experiment_folder())) {
    if (is_scene_file(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<NamedScene> read_experiments(const std::vector<std::string>& cases) {
  const std::vector<fs::path> known = experiment_files();
  std::vector<fs::path> files = cases.empty() ? known : std::vector<fs::path>{};
  for (const std::string& word : cases) files.push_back(file_of(word, known));
  std::vector<NamedScene> experiments;
  experiments.reserve(files.size());
  for (const fs::path& file : files) experiments.push_back(read_experiment(file));
  return experiments;
}

}  // namespace sprung
