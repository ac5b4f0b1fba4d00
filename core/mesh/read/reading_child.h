#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// What a reader may use up before it is stopped.
struct ReadingLimits {
  std::uint64_t memory = std::uint64_t{1} << 29;  // bytes, beyond those of this process; not in builds for ASan
  int cpu_time = 3;                               // s
  int wall_time = 15;                             // s
};

/// The mesh that `read` gives in a child process, so that a reader that crashes, hangs or eats memory takes nothing
/// with it. Its Error is thrown here; any other end becomes Error(kBadInput) that names `file` and what happened. What
/// the mesh holds is as `read` made it: only that it is whole is sure.
///
/// The child is a fork without exec: it costs a millisecond and needs no program on disk. It has the calling thread
/// only, so `read` must not use threads, nor a lock that another thread of this process may hold; memory allocation is
/// safe. It writes nothing: its standard output and errors lead nowhere, files it cannot write. Ctrl-C ends it, and it
/// ends with the thread that called. Deterministic as far as `read` is.
[[nodiscard]] SurfaceMesh read_in_child(const std::filesystem::path& file, const ReadingLimits& limits,
                                        const std::function<SurfaceMesh()>& read);

}  // namespace sprung
