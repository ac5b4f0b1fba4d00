#pragma once
#include <string>

#include "app/recording.h"

namespace sprung {

struct Quantity {
  double value = 0;
  std::string unit{};
};

/// What "tip.displacement.y" (also position, force, torque) or "frequency.1" is in the last frame.
/// Throws Error(kBadInput) where the recording has no such quantity.
[[nodiscard]] Quantity measure(const Recording& recording, const std::string& quantity);

}  // namespace sprung
