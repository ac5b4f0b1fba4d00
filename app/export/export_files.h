#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/console/console.h"
#include "app/film/frame_choice.h"
#include "app/scene/film.h"
#include "core/files.h"
#include "core/io/mesh_export.h"
#include "core/simulation/cache.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// Where exported frames go: one file per frame, or one for all frames (or one per body).
struct ExportTarget {
  enum class Kind { kMeshes, kAnimation, kPage, kPc2, kMdd, kXdmf };
  Kind kind = Kind::kMeshes;
  std::optional<NumberedName> numbered;  // for kMeshes, else file
  std::filesystem::path file;
  bool quantize = false;  // for kAnimation
};

/// "skin_{:04}.obj", "film.glb", "film.html", "points.pc2", "run.xdmf". Throws Error(kUsage).
[[nodiscard]] ExportTarget parse_export_target(std::string_view words);

/// A film in a cache. All must outlive it.
struct CachedFilmView {
  const Simulation& simulation;
  const CacheReader& cache;
  const Film& film;
};

/// The files that export_files() would write.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const ExportTarget& target, const Film& scene,
                                                          const FrameRange& range);

/// Writes every file under a temporary name and renames it. Throws Error, Interrupted.
void export_files(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range,
                  const Console& console);

/// The meshes of all bodies and their copies for these positions of the nodes (by body, m), with the vertices, order
/// and triangles of the files. They point into the simulation.
[[nodiscard]] std::vector<PosedMesh> posed_meshes(const Simulation& simulation, const Film& scene,
                                                  const std::vector<Points>& nodes);

}  // namespace sprung
