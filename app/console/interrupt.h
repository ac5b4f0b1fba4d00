#pragma once
#include "app/console/console.h"

namespace sprung {

/// From here on Ctrl-C (SIGINT), SIGTERM and SIGHUP ask the work to stop. If it does not within a third of a second, as
/// in a library that cannot be interrupted, the program is terminated: unfinished files are removed, and the console,
/// which must live as long as the program, says why. Signals that the parent process set to be ignored stay ignored. A
/// broken pipe makes the write fail instead of ending the program.
void catch_interrupts(const Console& console);

/// Work that takes longer than this (s, from now) is stopped likewise. To be called after catch_interrupts().
void limit_time(double seconds);

/// True once the work has to stop.
[[nodiscard]] bool is_interrupted();

/// As shells expect it: 128 plus the number of the signal; 1 if the time limit was reached.
[[nodiscard]] int interrupted_exit_code();

/// Says why the work stops.
void report_interruption(const Console& console);

/// Thrown to stop the work.
struct Interrupted {};

/// Throws Interrupted once the work has to stop.
void stop_if_interrupted();

/// Opens substitutes for standard streams that are closed, so that no file opened later gets their descriptors and is
/// written to by mistake. Writing to a closed stdout still fails.
void reserve_standard_files();

/// Throws Error(kFailed) if what was printed to stdout cannot be written: closed, disk full, broken pipe.
void flush_results();

}  // namespace sprung
