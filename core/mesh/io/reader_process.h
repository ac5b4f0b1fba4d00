#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// A mesh as bytes, for another process of the same build.
[[nodiscard]] std::vector<std::byte> bytes_from_mesh(const SurfaceMesh& mesh);

/// The mesh in such bytes. Throws Error(kFailed) where they are anything else, before allocating more than they hold.
[[nodiscard]] SurfaceMesh mesh_from_bytes(std::span<const std::byte> bytes);

/// Empty where a mesh is flat and whole: finite coordinates, corners in range, as many normals, UVs and colours as
/// positions or none, parts that cover all triangles in order and name materials that are there; else what is wrong.
[[nodiscard]] std::string find_fault(const SurfaceMesh& mesh);

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
