#pragma once
#include <filesystem>

#include "render/image/image.h"

namespace sprung {

/// Writes an OpenEXR file under a temporary name and renames it. The picture itself is R, G, B, A; layers: Shadow.X,
/// AO.X, Depth.Z, Normal.X, .Y and .Z, Position.X, .Y and .Z, IndexOB.X, UV.U, .V and .A (Blender reads none of two
/// numbers), Vector.X, .Y, .Z and .W, as Blender names its passes, and the mattes as Cryptomatte (CryptoObject00 to 02,
/// with the names in the metadata); 32-bit floats, compressed losslessly. Throws Error(kFailed).
void write_exr(const Passes& passes, const std::filesystem::path& file);

/// Reads such a file. Throws Error(kBadInput).
[[nodiscard]] Passes read_exr(const std::filesystem::path& file);

}  // namespace sprung
