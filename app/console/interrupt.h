#pragma once
#include "app/console/console.h"

namespace sprung {

/// From here on a Ctrl-C (SIGINT), SIGTERM or SIGHUP asks the work to stop. Work that does not within a third of a
/// second, such as a library that is not to be interrupted, is ended with the program: unfinished files are removed,
/// and the console, which must live as long as the program, tells why. Signals that whoever started the program has it
/// ignore stay ignored. A reader that went away is an error of the write instead of the end of the program.
void catch_interrupts(const Console& console);

/// Work that takes longer than this (s, from now) is stopped likewise. After catch_interrupts().
void limit_time(double seconds);

/// True once the work has to stop.
[[nodiscard]] bool is_interrupted();

/// As whoever started the program expects it: 128 and the number of the signal; 1 where its time was up.
[[nodiscard]] int interrupted_exit_code();

/// Says why the work stops.
void tell_interruption(const Console& console);

/// Thrown where the work stops.
struct Interrupted {};

/// Throws Interrupted once the work has to stop.
void stop_if_interrupted();

/// Puts something in the place of standard files that are closed, so that no file opened later gets their numbers and
/// is written into by mistake. What is written to a closed stdout then still fails.
void hold_standard_files();

/// Throws Error(kFailed) where what was printed to stdout cannot be written: closed, a full disk, a reader that left.
void flush_results();

}  // namespace sprung
