#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// What the program says on stderr. Results go to stdout and do not pass here. On a terminal every message takes the
/// place of a bar that stands there.
struct Console {
  bool is_terminal = false;  // stderr is one that can redraw a line in place (TERM is not "dumb")
  bool has_color = false;    // such a terminal, and NO_COLOR is not set
  bool quiet = false;        // errors and warnings only
  bool verbose = false;
  bool log_json = false;                         // a JSON object a line, in place of words
  std::vector<std::string>* warnings = nullptr;  // where set, keeps what warn() said

  /// Colours and terminal as they are for this process.
  [[nodiscard]] static Console of_process();

  /// "sprung: error: ..." for every line of the message.
  void error(std::string_view message) const;
  void warn(std::string_view message) const;
  void note(std::string_view message) const;
  /// A note that is shown with --verbose only.
  void detail(std::string_view message) const;
  /// With log_json: {"kind": "progress", "members"...}; `members` as they stand in the object.
  void event(std::string_view kind, std::string_view members) const;
};

}  // namespace sprung
