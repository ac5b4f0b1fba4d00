#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/compare.h"
#include "app/commands/materials.h"
#include "app/commands/validate.h"
#include "app/scene/scenarios.h"

namespace sprung {

/// One option that stands for a key of the scene, as it was typed.
struct Setting {
  std::string option;  // "--young"
  std::string key;     // "body.material.young"
  std::string value;
};

/// What `sprung animate`, `sprung simulate`, `sprung render`, `sprung export`, `sprung film`, `sprung sweep` and
/// `sprung inspect` were asked to do.
struct SceneOptions {
  std::string input;                 // a mesh or a scene; or a cache
  std::vector<std::string> others;   // of render: more caches, side by side
  std::vector<std::string> outputs;  // as typed
  std::vector<Setting> settings;
  std::optional<Scenario> scenario;
  std::string frames;  // of render, export and film: "1:48"
  int jobs = 0;        // of animate and render: processes that draw; 0: as many as pay
  int threads = 0;     // 0: as many as there are cores
  bool overwrite = false;
  bool resume = false;        // of simulate
  double position_error = 0;  // of simulate: m, that a cache may add; 0: none
  bool side_by_side = false;  // of render
  bool print_scene = false;
  bool quiet = false;
  bool verbose = false;
  bool list = false;              // of export
  bool quantize = false;          // of export
  bool table = false;             // of sweep
  std::optional<double> fps;      // of film
  bool json = false;              // of inspect
  std::filesystem::path picture;  // of inspect; empty: none
  std::string command;            // as it was typed, for a shell
};

struct CommandLine {
  enum class Command {
    kShowText,
    kMaterials,
    kAnimate,
    kSimulate,
    kRender,
    kExport,
    kFilm,
    kSweep,
    kInspect,
    kValidate,
    kCompare
  };
  Command command = Command::kShowText;
  std::string text;            // of kShowText: help or version
  SceneOptions scene;          // of all others but kMaterials and kCompare
  ValidateOptions validate;    // of kValidate
  CompareOptions compare;      // of kCompare
  MaterialsOptions materials;  // of kMaterials
};

/// Throws Error(kUsage), with the nearest word for a mistyped command or option.
[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv);

/// What the commands that take a scene have in common: finds the scene that the options mean and does `work` with it
/// on as many threads as they say; or prints the scene where that is all that was asked for. Throws Error.
void with_scene(const SceneOptions& options, const std::function<void(const Film&)>& work);

}  // namespace sprung

namespace CLI {
class App;
}

namespace sprung {

/// Lets options of one value be repeated as far as CLI11 is concerned, whose words about it are its own;
/// refuse_repeated refuses them after parsing.
void accept_repeated(CLI::App& command);

/// Throws Error(kUsage) for an option of one value that was given several times.
void refuse_repeated(const CLI::App& command);

/// Throws Error(kUsage) for the first word that nothing was made for, with the nearest word that there is, or the
/// command that has such an option. `kind` of a word that is no option: "unexpected".
void refuse_extras(const CLI::App& command, std::string_view kind);

}  // namespace sprung
