#pragma once
#include <cstddef>
#include <string>

#include "core/io/hdf5_file.h"
#include "core/skin/skin.h"

namespace sprung {

/// Where things are in a cache. Whoever changes it counts kCacheLayout up.
inline constexpr int kCacheLayout = 4;
inline constexpr const char* kLayoutName = "/layout";
inline constexpr const char* kProgressName = "/frames/progress";  // written last: a frame is there when its time is
inline constexpr const char* kProbesName = "/frames/probes";
inline constexpr const char* kHashName = "/frames/state_hash";
inline constexpr const char* kSecondsName = "/frames/seconds";
inline constexpr const char* kMemoryName = "/frames/memory";  // of frame f in row f % 2

/// In the folder of an actor: positions, then velocities of all nodes to the last bit, of frame f in row f % 2; without
/// columns where the frames themselves are kept so.
inline constexpr const char* kExactName = "/exact_state";

/// Counted from 1.
[[nodiscard]] inline std::string actor_folder(std::size_t actor) { return "/actors/" + std::to_string(actor + 1); }
[[nodiscard]] inline std::string mesh_folder(std::size_t body) { return "/meshes/" + std::to_string(body + 1); }
[[nodiscard]] inline std::string obstacle_folder(std::size_t obstacle) {
  return "/obstacles/" + std::to_string(obstacle + 1);
}

/// A skin in a folder of a cache: "folder/positions", "folder/triangles" and so on.
void write_skin(Hdf5Writer& hdf5, const std::string& folder, const Skin& skin);
[[nodiscard]] Skin read_skin(const Hdf5Reader& hdf5, const std::string& folder);

}  // namespace sprung
