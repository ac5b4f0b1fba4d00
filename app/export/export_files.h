#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/export/animation_formats.h"
#include "core/files.h"

namespace sprung {

/// The destination of exported frames: one file for all (or one for each mesh), or one file for each.
struct ExportTarget {
  const AnimationFormat* animation = nullptr;  // null: a mesh file for each frame
  std::filesystem::path file;                  // of the animation, or of a single frame
  std::optional<NumberedName> numbered;        // of the frames
  bool quantize = false;
};

/// "skin_{:04}.obj", "film.glb", "film.html", "points.pc2", "run.xdmf". Throws Error(kUsage).
[[nodiscard]] ExportTarget parse_export_target(std::string_view words);

/// "skin_{:04}.obj, film.glb, ..., run.xdmf": a name for each kind of target.
[[nodiscard]] std::string example_targets();

/// The files that export_files() would write.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const ExportTarget& target, const Film& film,
                                                          const FrameRange& range);

/// Writes every file under a temporary name and renames it. Several takes need a format that holds them. Throws Error,
/// Interrupted.
void export_files(const ExportTarget& target, std::span<const CachedFilmView> takes, const FrameRange& range,
                  const Console& console);

}  // namespace sprung
