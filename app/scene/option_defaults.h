#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// The value of an option of the command line that is not typed.
struct OptionDefault {
  std::string command;              // "animate"; empty: every command that has the option
  std::string option;               // "--fps"
  std::vector<std::string> values;  // as they would be typed
  int line = 0;                     // of the file
};

/// The defaults of a site or a project.
struct OptionDefaults {
  std::filesystem::path file;  // empty: none
  bool is_of_environment = false;
  std::vector<OptionDefault> list;

  /// The default for the command, else that for all; null: none.
  [[nodiscard]] const OptionDefault* find(std::string_view command, std::string_view option) const;
  /// "sprung.toml:3"
  [[nodiscard]] std::string location(const OptionDefault& one) const;
};

/// The TOML file that the environment variable SPRUNG_CONFIG names, or else sprung.toml in the working folder or the
/// nearest one above it. If the variable is set but empty, no file is searched for. A key is an option without its
/// dashes, for all commands; in a table of a command's name, for that command. Throws Error(kBadInput).
inline constexpr const char* kConfigVariable = "SPRUNG_CONFIG";
inline constexpr const char* kConfigName = "sprung.toml";
[[nodiscard]] OptionDefaults option_defaults();

/// The defaults in a file.
[[nodiscard]] OptionDefaults read_option_defaults(const std::filesystem::path& file);

}  // namespace sprung
