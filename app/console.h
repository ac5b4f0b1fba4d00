#pragma once
#include <string>
#include <string_view>

namespace sprung {

/// What the program says on stderr. Results go to stdout and do not pass here.
struct Console {
  bool is_terminal = false;  // stderr is one: bars may be redrawn in place
  bool has_color = false;    // a terminal, and NO_COLOR is not set
  bool quiet = false;        // errors and warnings only
  bool verbose = false;

  /// Colours and terminal as they are for this process.
  [[nodiscard]] static Console of_process();

  /// "sprung: error: ..." for every line of the message.
  void error(std::string_view message) const;
  void warn(std::string_view message) const;
  void note(std::string_view message) const;
  /// A note that is shown with --verbose only.
  void detail(std::string_view message) const;
};

}  // namespace sprung
