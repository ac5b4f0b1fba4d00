#pragma once
#include <CLI/CLI.hpp>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/make_scene.h"
#include "app/console/console.h"
#include "app/film/film_output.h"
#include "app/film/frame_choice.h"
#include "app/scene/scene_reference.h"
#include "app/scene/scene_values.h"
#include "core/error.h"

namespace sprung {

// Options shared by several commands. CLI11 writes into these structs: they must not move once add_to() was called.

/// The group of options that --help leaves out; `sprung help COMMAND` names them too.
inline constexpr const char* kMoreOptions = "More options";

/// --quiet, --verbose and --log-json, which set the console directly.
void add_messages(CLI::App& command, Console& console, const std::string& verbose = "more about every stage");

/// A whole number, at least 1, given as text for the option of that name; 0 if the text is empty. Throws Error(kUsage).
[[nodiscard]] int count_in(std::string_view option, const std::string& text);

/// A value of a key of the scene, given as text for an option; none if it is not given. Throws Error(kUsage).
template <class Value>
[[nodiscard]] std::optional<Value> key_value(const CLI::Option& option, std::string_view key, const std::string& text) {
  if (option.count() == 0) return std::nullopt;
  try {
    Value value{};
    parse_value(text, key_at(key), value);
    return value;
  } catch (const Error& error) {
    throw Error(ErrorKind::kUsage, option.get_name() + ": " + error.what());
  }
}

/// Throws Error(kUsage) if `file` exists and may not be replaced.
void refuse_existing(const std::filesystem::path& file, bool overwrite,
                     std::string_view remedy = "--overwrite to replace it");

/// Removes what an earlier, longer film left beyond the last picture of this one, and says so.
void clear_beyond(const Output& output, int last, const Console& console);

/// --frames, --frame, --time and --start-number.
struct FrameOptions {
  std::string frames;  // "1:48:2"
  std::string frame;
  std::string time;
  std::string start_number;

  void add_to(CLI::App& command);
  /// For a film of that many frames at that rate. Throws Error(kUsage).
  [[nodiscard]] FrameChoice choice(std::size_t frames_in_film, double fps) const;
  [[nodiscard]] bool is_whole_film() const { return frames.empty() && frame.empty() && time.empty(); }
};

inline constexpr const char* kPicturesHelp = "folder/, f_{:04}.png, still.png, film.mp4, .webm, .mov, .gif, or -";

/// -o.
struct OutputOptions {
  std::vector<std::string> names;  // as typed

  void add_to(CLI::App& command, const std::string& help, const char* placeholder = "OUT");
  /// Throws Error(kUsage) with the example if none is given.
  void require(const CLI::App& command, std::string_view example) const;
  /// Names what was written, but not among pictures on the standard output.
  void print() const;
};

/// Throws Error(kUsage) if there is no input: "a mesh or a scene".
void require_input(const CLI::App& command, const std::string& input, std::string_view what);

/// --jobs.
struct JobOptions {
  std::string text;

  CLI::Option* add_to(CLI::App& command);
  /// Number of drawing processes; 0: as many as are worthwhile.
  [[nodiscard]] int count() const { return count_in("--jobs", text); }
};

/// An option for a key of the scene; its help is that of the key.
struct KeyOption {
  const char* option;
  std::string_view key;
  const char* example;
  struct Use {
    bool is_of_pictures = false;  // useless if none are drawn
    bool is_common = false;       // named by --help; the others by sprung help COMMAND
  } use{};
};

/// Every such option, in the order of its help.
[[nodiscard]] std::span<const KeyOption> key_options();

/// The defaults of a command's options that stand for keys of the scene: of all of them and of --set, since a cache may
/// record the scene for other commands; or only of those for which `is_meant` holds. Throws Error(kUsage).
[[nodiscard]] std::vector<Setting> default_settings(const OptionDefaults& defaults, std::string_view command);
[[nodiscard]] std::vector<Setting> default_settings(const OptionDefaults& defaults, std::string_view command,
                                                    const std::function<bool(const KeyOption&)>& is_meant);

/// Options that stand for keys of the scene, and --set.
struct SettingOptions {
  /// Adds the key options for which `is_meant` holds.
  void add_keys(CLI::App& command, Invocation& invocation, const std::function<bool(const KeyOption&)>& is_meant);
  void add_set(CLI::App& command, Invocation& invocation, const std::string& help,
               const char* placeholder = "KEY=VALUE");
  /// The settings as typed, --set last. Throws Error(kUsage).
  [[nodiscard]] std::vector<Setting> settings() const;

 private:
  struct Word {
    const KeyOption& key;
    std::string text;
    const CLI::Option* option = nullptr;
  };
  std::deque<Word> words_;
  std::vector<std::string> sets_;
};

/// The input and the options of a command that takes a mesh or a scene.
struct SceneOptions {
  std::string input;
  SettingOptions keys;
  std::vector<Setting> defaults;  // of a site or project, including keys of pictures, which caches record
  std::string scenario;
  std::string unit;
  std::string up;
  std::string view;
  std::string threads;
  bool print_scene = false;

  void add_to(CLI::App& command, Invocation& invocation, bool has_pictures,
              const std::string& input_help = "a mesh file, or a scene (.toml)");
  [[nodiscard]] SceneRequest request() const;
  /// Runs `work` on the scene with as many threads as the options say, or just prints the scene if that was requested.
  void with_scene(const Console& console, const std::function<void(const Film&)>& work) const;
};

/// `examples`, followed by what applies to every command that takes a scene.
[[nodiscard]] std::string scene_footer(const CLI::App& command, const std::string& examples);

}  // namespace sprung
