#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/console/console.h"
#include "app/film/frame_choice.h"
#include "app/scene/film.h"
#include "core/simulation/cache.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// A film in a cache. The objects that it refers to must outlive it.
struct CachedFilmView {
  const Simulation& simulation;
  const CacheReader& cache;
  const Film& film;
  std::string name;  // among several takes
};

/// Which part of a film to write, and to which file.
struct AnimationJob {
  const std::filesystem::path& file;
  std::span<const CachedFilmView> takes;  // one, or more if the format holds_takes
  const FrameRange& range;
  bool quantize = false;  // for formats that can
  const Console& console;

  [[nodiscard]] const CachedFilmView& film() const { return takes.front(); }
};

/// A file format for all frames of a film. A new one is a writer and a row of animation_formats().
struct AnimationFormat {
  std::string_view extension;  // ".glb"
  std::string_view example;    // "film.glb"
  std::string_view what;       // for messages
  bool is_per_mesh = false;    // several files if a film has several meshes
  bool can_quantize = false;
  bool holds_takes = false;                          // several films in one file
  void (*write)(const AnimationJob& job) = nullptr;  // throws Error, Interrupted
};
[[nodiscard]] std::span<const AnimationFormat> animation_formats();

/// Finds the format by the extension of a file, ignoring case; null for an unknown one.
[[nodiscard]] const AnimationFormat* find_animation_format(const std::filesystem::path& file);

/// points.pc2, or points_1.pc2 ... for several meshes.
[[nodiscard]] std::filesystem::path file_of_mesh(const std::filesystem::path& file, std::size_t mesh,
                                                 std::size_t count);

}  // namespace sprung
