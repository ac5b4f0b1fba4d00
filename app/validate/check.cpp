#include "app/validate/check.h"

#include <cmath>

namespace sprung {

double Check::error() const {
  if (is_least && measured >= expected) return 0;
  return expected == 0 ? measured : measured / expected - 1;
}

bool Check::is_gate() const { return !std::isnan(tolerance); }

// A measurement that is not a number is a failure: no comparison with it holds.
bool Check::passed() const { return !is_gate() || std::abs(error()) <= tolerance; }

}  // namespace sprung
