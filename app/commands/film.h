#pragma once
#include "app/commands/command_line.h"
#include "app/console/console.h"

namespace sprung {

/// `sprung film`: numbered pictures, drawn by whomever, to films; the films' names go to stdout.
/// Throws Error(kBadInput) naming every gap in the numbers, Error(kFailed), Interrupted.
void make_film(const SceneOptions& options, const Console& console);

}  // namespace sprung
