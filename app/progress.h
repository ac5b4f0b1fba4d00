#pragma once
#include <chrono>
#include <string>

#include "app/console.h"

namespace sprung {

/// "simulate" with its bar, rate and time to go on a terminal; one plain line when the stage is over in any case. With
/// Console::log_json an object at its start and then every second, {"kind": "progress", "stage", "share" (0 to 1),
/// "seconds", "seconds_to_go" (null: not known yet)}, and {"kind": "stage", "stage", "seconds", "result"} at its end.
class Progress {
 public:
  /// `total` units of work; the rate is shown as `scale` times units a second, for example 1e-6 and "M brick-steps/s".
  Progress(const Console& console, std::string stage, double total = 0, double scale = 1, std::string rate_unit = "");
  /// Clears a bar that an error left standing.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` units so far; redraws at most ten times a second.
  void update(double done);
  /// Ends the stage with its line: name, seconds, what came out of it, rate.
  void finish(const std::string& summary);

  [[nodiscard]] double seconds() const;
  /// Seconds to go at the rate so far; 0 where nothing is known.
  [[nodiscard]] double seconds_to_go() const;

 private:
  void draw();
  void report() const;
  void clear();
  [[nodiscard]] std::string rate() const;

  using Clock = std::chrono::steady_clock;
  const Console& console_;
  std::string stage_;
  double total_;
  double scale_;
  std::string rate_unit_;
  double done_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_draw_{};
  bool is_drawn_ = false;
};

/// "12 s", "3 min 05 s", "2 h 10 min", "5 days", "12 years".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace sprung
