#pragma once
#include "app/console/console.h"

namespace sprung {

/// Does what the words of the command line ask for and returns the exit code. Throws Error(kUsage), with the nearest
/// word for a mistyped command or option; what the commands throw.
[[nodiscard]] int run_command_line(int argc, const char* const* argv, Console& console);

}  // namespace sprung
