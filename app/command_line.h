#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/compare.h"
#include "app/materials/list_materials.h"
#include "app/scene/scenarios.h"
#include "app/validate/validate.h"

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

}  // namespace sprung
