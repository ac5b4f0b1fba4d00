#pragma once
#include <filesystem>
#include <vector>

namespace sprung::test {

/// Writes small closed shapes with UVs, normals, colours, a material and two instances into a folder, in every format
/// that the reader takes and assimp can write, and OFF and binary PLY; the files written. Throws std::runtime_error
/// where that fails.
[[nodiscard]] std::vector<std::filesystem::path> write_mesh_corpus(const std::filesystem::path& folder);

}  // namespace sprung::test
