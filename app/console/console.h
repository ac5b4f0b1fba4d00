#pragma once
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation/observer.h"

namespace sprung {

/// The messages of the program on stderr; results go to stdout, not through here. On a terminal a stage of work has a
/// progress bar with its rate and the remaining time, redrawn at most ten times a second; messages replace it. Every
/// stage ends with one plain line. With log_json every line is an object, see README.md. Interrupts by signals stop the
/// work.
class Console : public Observer {
 public:
  bool is_terminal = false;                      // stderr is one that can redraw a line in place (TERM is not "dumb")
  bool has_color = false;                        // such a terminal, and NO_COLOR is not set
  bool quiet = false;                            // errors and warnings only
  bool verbose = false;                          // details too
  bool log_json = false;                         // one JSON object per line instead of text
  std::vector<std::string>* warnings = nullptr;  // if set, collects what is passed to warn()

  /// A console with the terminal and colours of this process.
  [[nodiscard]] static Console of_process();
  /// A console that prints errors and warnings only.
  [[nodiscard]] static Console terse();

  /// "sprung: error: ..." for every line of the message.
  void error(std::string_view message) const;
  void warn(std::string_view message) const override;
  void note(std::string_view message) const override;
  void detail(std::string_view message) const override;
  /// Prints with log_json only.
  void look_at(const Crossings& crossings) const override;
  void show(const Progress& progress) const override;
  void finish(const Progress& progress, std::string_view result) const override;
  void clear(const Progress& progress) const override;
  void check_interrupt() const override;

 private:
  mutable std::chrono::steady_clock::time_point shown_at_{};
  mutable bool has_bar_ = false;
};

}  // namespace sprung
