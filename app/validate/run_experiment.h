#pragma once
#include <string>

#include "app/console/console.h"
#include "app/scene/film.h"
#include "app/validate/case_result.h"

namespace sprung {

/// Takes the scene through every model, Poisson's ratio and grid of its experiment, and compares with its
/// expectations. Where a model cannot be carried through, its checks measure NaN and say why. For every model of
/// springs one more check holds the most crushed brick of all frames against the volume at which the guard would act:
/// what passes is the answer of the springs alone. `name` is for the checks. Throws Error(kBadInput) where a quantity
/// is none of the scene's, Interrupted.
[[nodiscard]] CaseResult run_experiment(const std::string& name, const Film& scene, const Choice& choice,
                                        const Console& console);

}  // namespace sprung
