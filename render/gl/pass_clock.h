#pragma once
#include <string_view>
#include <vector>

#include "render/gl/functions.h"
#include "render/image/image.h"

namespace sprung {

/// Measures the passes of drawing. It waits for the end of each, so nothing overlaps while it is on; off, it costs
/// nothing.
class PassClock {
 public:
  PassClock(const GlFunctions& gl, bool is_on) : gl_(gl), is_on_(is_on) {}
  /// The next pass begins now.
  void start();
  /// A pass is over and the next begins. `pass` is a literal.
  void stop(std::string_view pass);
  [[nodiscard]] const std::vector<PassTime>& times() const { return times_; }

 private:
  const GlFunctions& gl_;
  bool is_on_;
  double wall_ = 0;
  double processor_ = 0;
  std::vector<PassTime> times_;
};

}  // namespace sprung
