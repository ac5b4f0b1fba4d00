#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "core/mesh/surface_mesh.h"

namespace sprung {

/// Serializes a mesh for another process of the same build.
[[nodiscard]] std::vector<std::byte> bytes_from_mesh(const SurfaceMesh& mesh);

/// The inverse. Throws Error(kFailed) for malformed bytes, before allocating more than they contain.
[[nodiscard]] SurfaceMesh mesh_from_bytes(std::span<const std::byte> bytes);

/// Empty for a valid mesh: finite coordinates, corners in range, as many normals, UVs and colours as positions or none,
/// parts that cover all triangles in order and refer to existing materials; else what is wrong.
[[nodiscard]] std::string find_fault(const SurfaceMesh& mesh);

/// The resources a reader may use before it is stopped.
struct ReadingLimits {
  std::uint64_t memory = std::uint64_t{1} << 29;  // bytes, beyond those of this process; not in builds for ASan
  int cpu_time = 3;                               // s
  int wall_time = 15;                             // s
};

/// Runs `read` in a child process, so that a reader that crashes, hangs or exhausts memory does no harm here. Its Error
/// is rethrown; any other failure becomes an Error(kBadInput) that names `file` and what happened. The mesh is checked
/// by find_fault(), nothing else.
///
/// The child is forked without exec, which takes a millisecond and needs no executable on disk. It has the calling
/// thread only, so `read` must not use threads or a lock that another thread of this process may hold; memory
/// allocation is safe. It cannot write: standard output and error are discarded, files cannot be opened for writing. It
/// ends on Ctrl-C and with the calling thread. As deterministic as `read`.
[[nodiscard]] SurfaceMesh read_in_child(const std::filesystem::path& file, const ReadingLimits& limits,
                                        const std::function<SurfaceMesh()>& read);

}  // namespace sprung
