#pragma once
#include <filesystem>

#include "assets/models/toy.h"

namespace sprung::models {

/// Writes a binary little-endian PLY: float positions and normals, uchar colours. The same toy gives the same bytes.
/// Throws Error(kFailed) where the file cannot be written.
void write_ply(const Toy& toy, const std::filesystem::path& file);

}  // namespace sprung::models
