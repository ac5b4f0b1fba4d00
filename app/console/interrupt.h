#pragma once

namespace sprung {

/// From here on the first Ctrl-C (SIGINT), SIGTERM or SIGHUP only sets a flag, and one that comes more than a moment
/// later ends the program at once; signals that whoever started the program has it ignore stay ignored. A reader that
/// went away is an error of the write instead of the end of the program.
void catch_interrupts();

/// True after the first of these signals.
[[nodiscard]] bool is_interrupted();

/// Whichever signal it was: what there is can be gone on with.
inline constexpr int kInterruptedExitCode = 130;

/// Thrown where the work stops because of such a signal.
struct Interrupted {};

/// Throws Interrupted after the first of these signals.
void stop_if_interrupted();

/// Puts something in the place of standard files that are closed, so that no file opened later gets their numbers and
/// is written into by mistake. What is written to a closed stdout then still fails.
void hold_standard_files();

/// Throws Error(kFailed) where what was printed to stdout cannot be written: closed, a full disk, a reader that left.
void flush_results();

}  // namespace sprung
