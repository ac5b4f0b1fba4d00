#pragma once
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/key_options.h"

namespace CLI {
class App;
}

namespace sprung {

/// Everything that CLI11 fills in.
struct RawOptions {
  SceneOptions scene;
  ValidateOptions validate;
  CompareOptions compare;
  MaterialsOptions materials;
  std::string model;
  std::string poisson;
  std::string bricks;
  std::vector<std::string> scene_values = std::vector<std::string>(sprung::key_options().size());
  std::vector<std::string> set;
  std::string scenario;
  std::string threads;
  std::string jobs;
  std::string position_error;
  std::string fps;    // of film
  std::string topic;  // of help
  bool json_schema = false;
  bool log_json = false;  // main looks for it by itself: mistakes in the words are said so too
};

/// CLI11's group of options that --help leaves out; show_all brings them back.
inline constexpr const char* kMoreOptions = "";

/// All commands with their options, which write into the words; these have to outlive the parsing.
void add_commands(CLI::App& app, RawOptions& words);

/// Lets the help of a command name all its options.
void show_all(CLI::App& command);

}  // namespace sprung
