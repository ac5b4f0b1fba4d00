#pragma once
#include <functional>

#include "app/console.h"
#include "app/frame_range.h"

namespace sprung {

/// Does work on a range of frames in parts, each in a process of its own, all at once; in this one where `jobs` is 1.
/// Others say errors and warnings only. To be called while this process has one thread.
/// Throws Error(kFailed) naming the parts that failed once all have ended, Interrupted.
void run_jobs(const FrameRange& range, int jobs, const Console& console,
              const std::function<void(const FrameRange& part, const Console& console)>& work);

}  // namespace sprung
