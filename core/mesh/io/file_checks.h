#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace sprung {

/// The ending of a file's name in lower case, with its dot: ".obj".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

/// Throws Error(kBadInput) naming file and reason where it is missing, a folder, a pipe, a device or closed to us.
void check_readable(const std::filesystem::path& file);

/// The whole of a file. Throws Error(kBadInput) where it cannot be read.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& file);

/// Refuses a GLB that is shorter than its header says, and one or a glTF that needs an extension that assimp would pass
/// over and get the shape wrong. `bytes`: of the whole file. Throws Error(kBadInput).
void check_glb(std::string_view bytes, const std::string& name);
void check_gltf(std::string_view bytes, const std::string& name);

/// Refuses a 3MF archive that is cut short or holds no model. Throws Error(kBadInput).
void check_3mf(std::string_view bytes, const std::string& name);

}  // namespace sprung
