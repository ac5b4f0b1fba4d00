#pragma once
#include <filesystem>

#include "render/image/image.h"

namespace sprung {

/// Writes an OpenEXR file beside its name and renames it. Layers: Depth.Z, Normal.X, .Y and .Z, Position.X, .Y and .Z,
/// IndexOB.X, UV.U and .V, Vector.X, .Y, .Z and .W, as Blender names its passes, and the mattes as Cryptomatte
/// (CryptoObject00 to 02, with the names in the metadata); 32-bit floats, compressed losslessly.
/// Throws Error(kFailed).
void write_exr(const Passes& passes, const std::filesystem::path& file);

/// Reads such a file. Throws Error(kBadInput).
[[nodiscard]] Passes read_exr(const std::filesystem::path& file);

}  // namespace sprung
