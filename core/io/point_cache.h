#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// The positions of one mesh's vertices in every frame (n x 3, m), as Blender's Mesh Cache modifier and others read
/// them: .pc2 (Point Cache 2, little endian) and .mdd (LightWave, big endian, with times). Written beside the name and
/// renamed. Throws Error(kFailed).
void write_pc2(const std::vector<Floats3>& frames, const std::filesystem::path& file);
/// `times` in s.
void write_mdd(const std::vector<Floats3>& frames, std::span<const double> times, const std::filesystem::path& file);

}  // namespace sprung
