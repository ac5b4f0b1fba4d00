#pragma once
#include <cstddef>
#include <string>

#include "core/io/hdf5_file.h"
#include "core/skin/skin.h"

namespace sprung {

/// The layout of a cache. Increment kCacheLayout with every change.
inline constexpr int kCacheLayout = 5;
inline constexpr const char* kLayoutName = "/layout";
inline constexpr const char* kProgressName = "/frames/progress";  // written last: completes a frame
inline constexpr const char* kProbesName = "/frames/probes";
inline constexpr const char* kHashName = "/frames/state_hash";
inline constexpr const char* kSecondsName = "/frames/seconds";
inline constexpr const char* kMemoryName = "/frames/memory";  // of frame f in row f % 2

/// In the folder of a body: the exact positions, then velocities of all nodes, of frame f in row f % 2; no columns
/// where the frames themselves are exact.
inline constexpr const char* kExactName = "/exact_state";

/// Counted from 1.
[[nodiscard]] inline std::string body_folder(std::size_t body) { return "/actors/" + std::to_string(body + 1); }
[[nodiscard]] inline std::string mesh_folder(std::size_t body) { return "/meshes/" + std::to_string(body + 1); }
[[nodiscard]] inline std::string obstacle_folder(std::size_t obstacle) {
  return "/obstacles/" + std::to_string(obstacle + 1);
}

/// A skin in a folder of a cache: "folder/positions", "folder/triangles" etc.
void write_skin(Hdf5Writer& hdf5, const std::string& folder, const Skin& skin);
[[nodiscard]] Skin read_skin(const Hdf5Reader& hdf5, const std::string& folder);

}  // namespace sprung
