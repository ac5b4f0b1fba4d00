#pragma once
#include <algorithm>

#include "core/body/kernel/pack.h"
#include "core/body/kernel/tile.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// A part of a run: its places begin .. end - 1, counted from the run's first.
struct RunPart {
  const Run& run;
  int begin;
  int end;

  [[nodiscard]] int place() const { return run.place + begin; }
  [[nodiscard]] int count() const { return end - begin; }

  /// Calls visit(place) for each pack.
  template <class Visit>
  void each_pack(const Visit& visit) const {
    for (int i = begin; i < end; i += kLanes) visit(run.place + i);
  }
};

/// Goes through the runs of one kind in a plane, up to one place after the other.
class RunCursor {
 public:
  RunCursor(const TileView& tile, int plane, RunKind kind)
      : run_(tile.runs + tile.first_run[plane * kRunKinds + kind]),
        last_(tile.runs + tile.first_run[plane * kRunKinds + kind + 1]),
        unit_(kind < kPlaces ? 1 : kPackPadding) {}

  /// Calls visit(part) for all nodes, or packs, that begin before this place and were not visited yet.
  template <class Visit>
  void go_to(int place, const Visit& visit) {
    while (run_ != last_ && run_->place + done_ < place) {
      const int end = std::min(run_->count, (place - run_->place + unit_ - 1) & -unit_);
      visit(RunPart{*run_, done_, end});
      done_ = end;
      if (end < run_->count) return;
      ++run_;
      done_ = 0;
    }
  }

 private:
  const Run* run_;
  const Run* last_;
  int unit_;      // places
  int done_ = 0;  // of the run's places
};

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
