#pragma once
#include <string>

#include "app/validate/node_errors.h"
#include "core/simulation/recorder.h"

namespace sprung {

struct Quantity {
  double value = 0;
  std::string unit{};
};

/// What "tip.displacement.y" (also position, force, torque), "frequency.1" or "nodes.max_error" (also mean_error,
/// rms_error) is in the last frame; `errors` of its nodes, null where no solution is known to hold them against.
/// Throws Error(kBadInput) where the recording has no such quantity.
[[nodiscard]] Quantity measure(const Recording& recording, const NodeErrors* errors, const std::string& quantity);

}  // namespace sprung
