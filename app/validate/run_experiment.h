#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/console.h"
#include "app/scene.h"
#include "app/validate/check.h"

namespace sprung {

/// What a person wants instead of what the experiment varies.
struct Choice {
  std::optional<Model> model;
  std::optional<double> poisson;
  std::optional<int> bricks;
};

/// Takes the scene through every model, Poisson's ratio and grid of its experiment, and compares with its
/// expectations. Where a model cannot be carried through, its checks measure NaN. `name` is for the checks.
/// Throws Error(kBadInput) where a quantity is none of the scene's, Interrupted.
[[nodiscard]] std::vector<Check> run_experiment(const std::string& name, const Scene& scene, const Choice& choice,
                                                const Console& console);

}  // namespace sprung
