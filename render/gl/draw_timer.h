#pragma once
#include <string_view>
#include <vector>

#include "render/gl/functions.h"
#include "render/image/image.h"

namespace sprung {

/// Measures the passes of drawing. It waits for the end of each, so that none overlap while it is on.
class DrawTimer {
 public:
  DrawTimer(const GlFunctions& gl, bool is_on) : gl_(gl), is_on_(is_on) {}
  /// Begins the first pass.
  void start();
  /// Ends a pass and begins the next. `pass` is a literal.
  void stop(std::string_view pass);
  [[nodiscard]] const std::vector<DrawTime>& times() const { return times_; }

 private:
  const GlFunctions& gl_;
  bool is_on_;
  double wall_ = 0;
  double processor_ = 0;
  std::vector<DrawTime> times_;
};

}  // namespace sprung
