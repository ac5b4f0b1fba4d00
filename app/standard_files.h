#pragma once

namespace sprung {

/// Puts something in the place of standard files that are closed, so that no file opened later gets their numbers and
/// is written into by mistake. What is written to a closed stdout then still fails.
void hold_standard_files();

/// Throws Error(kFailed) where what was printed to stdout cannot be written: closed, a full disk, a reader that left.
void flush_results();

}  // namespace sprung
