#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command_line.h"

namespace CLI {
class App;
}

namespace sprung {

/// An option for a key of the scene; its help is that of the key.
struct KeyOption {
  const char* option;
  std::string_view key;
  const char* example;
  struct Use {
    bool is_of_pictures = false;  // of no use where none are drawn
    bool is_common = false;       // named by --help; the others by sprung help COMMAND
  } use{};
};

/// Every such option, in the order of its help.
[[nodiscard]] std::span<const KeyOption> key_options();

/// What the key does.
[[nodiscard]] std::string help_of(const KeyOption& option);

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
