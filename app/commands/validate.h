#pragma once
#include <string>
#include <vector>

#include "app/console/console.h"
#include "app/validate/check.h"

namespace sprung {

/// What `sprung validate` was asked to do.
struct ValidateOptions {
  std::vector<std::string> cases{};  // names of built-in experiments or scene files; none: all that are built in
  Choice choice{};
  std::string report{};  // folder; empty: none
  bool list = false;
  bool json = false;
};

/// Runs experiments and prints their checks to stdout. False where any check fails.
/// Throws Error(kUsage) for an unknown name, Error(kBadInput), Error(kFailed), Interrupted.
[[nodiscard]] bool validate(const ValidateOptions& options, const Console& console);

}  // namespace sprung
