#pragma once
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulation/observer.h"

namespace sprung {

/// What the program says on stderr. Results go to stdout and do not pass here. On a terminal every message takes the
/// place of a bar that stands there. A stage of work has a bar with its rate and the time to go there, redrawn at most
/// ten times a second, and one plain line when it is over in any case. With log_json every line is an object, see
/// README.md. Interrupts by signals stop the work.
class Console : public Observer {
 public:
  bool is_terminal = false;                      // stderr is one that can redraw a line in place (TERM is not "dumb")
  bool has_color = false;                        // such a terminal, and NO_COLOR is not set
  bool quiet = false;                            // errors and warnings only
  bool verbose = false;                          // details too
  bool log_json = false;                         // a JSON object a line, in place of words
  std::vector<std::string>* warnings = nullptr;  // where set, keeps what warn() said

  /// Colours and terminal as they are for this process.
  [[nodiscard]] static Console of_process();
  /// One that says errors and warnings only.
  [[nodiscard]] static Console of_few_words();

  /// "sprung: error: ..." for every line of the message.
  void error(std::string_view message) const;
  void warn(std::string_view message) const override;
  void note(std::string_view message) const override;
  void detail(std::string_view message) const override;
  void show(const Progress& progress) const override;
  void finish(const Progress& progress, std::string_view result) const override;
  void clear(const Progress& progress) const override;
  void check_interrupt() const override;

 private:
  mutable std::chrono::steady_clock::time_point shown_at_{};
  mutable bool has_bar_ = false;
};

}  // namespace sprung
