#pragma once

namespace sprung {

/// From here on the first Ctrl-C only sets a flag (the second one kills), and a reader that went away is an error of
/// the write instead of the end of the program.
void catch_interrupts();

/// True after the first Ctrl-C.
[[nodiscard]] bool is_interrupted();

/// Thrown where the work stops because of Ctrl-C.
struct Interrupted {};

/// Throws Interrupted after the first Ctrl-C.
void stop_if_interrupted();

}  // namespace sprung
