#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/build_world.h"
#include "app/console.h"
#include "app/frame_range.h"
#include "app/numbered_name.h"
#include "core/io/cache.h"

namespace sprung {

/// Where exported frames go: a file each, or all into one (or one for each body).
struct ExportTarget {
  enum class Kind { kMeshes, kAnimation, kPage, kPc2, kMdd, kXdmf };
  Kind kind = Kind::kMeshes;
  std::optional<NumberedName> numbered;  // of kMeshes; or
  std::filesystem::path file;
  bool quantize = false;  // of kAnimation
};

/// "skin_{:04}.obj", "film.glb", "film.html", "points.pc2", "run.xdmf". Throws Error(kUsage).
[[nodiscard]] ExportTarget parse_export_target(std::string_view words);

/// A film as it is in a cache.
struct Film {
  const Production& production;
  const CacheReader& cache;
  const Scene& scene;
};

/// The files that would be written.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const ExportTarget& target, const Scene& scene,
                                                          const FrameRange& range);

/// Writes them, each beside its name and renamed. Throws Error, Interrupted.
void export_files(const ExportTarget& target, const Film& film, const FrameRange& range, const Console& console);

}  // namespace sprung
