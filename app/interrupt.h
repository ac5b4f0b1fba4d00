#pragma once

namespace sprung {

/// From here on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only sets a flag, and one that comes more than a moment
/// later kills; signals that whoever started the program has it ignore stay ignored. A reader that went away is an
/// error of the write instead of the end of the program.
void catch_interrupts();

/// True after the first of these signals.
[[nodiscard]] bool is_interrupted();

/// The exit code that a shell gives to a program ended by that signal: 130 for Ctrl-C, 143 for SIGTERM, 129 for SIGHUP.
[[nodiscard]] int interrupted_exit_code();

/// Thrown where the work stops because of such a signal.
struct Interrupted {};

/// Throws Interrupted after the first of these signals.
void stop_if_interrupted();

}  // namespace sprung
