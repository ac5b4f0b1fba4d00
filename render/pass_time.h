#pragma once
#include <string_view>

namespace sprung {

/// What one pass of drawing has taken, of all pictures so far.
struct PassTime {
  std::string_view pass;
  double wall = 0;       // s
  double processor = 0;  // s, of all threads
};

}  // namespace sprung
