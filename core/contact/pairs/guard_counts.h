#pragma once

namespace sprung {

/// In how many steps of groups of bodies a CrossingGuard acted, and by which of its means; each includes those after
/// it.
struct GuardCounts {
  long steps = 0;     // altogether
  long impulses = 0;  // with impulses
  long slowed = 0;    // with nodes slowed down
  long welded = 0;    // with nodes that move as one
  long failed = 0;    // in which something may have crossed nevertheless

  GuardCounts& operator+=(const GuardCounts& other) {
    steps += other.steps;
    impulses += other.impulses;
    slowed += other.slowed;
    welded += other.welded;
    failed += other.failed;
    return *this;
  }
};

}  // namespace sprung
