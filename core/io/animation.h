#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/io/mesh_export.h"
#include "core/skin/skin.h"

/// Files that hold a mesh in all its frames. All functions write by way of a PartialFile and throw Error(kFailed).
namespace sprung {

/// The positions of one mesh's vertices in every frame (n x 3, m), as Blender's Mesh Cache modifier reads them: .pc2
/// (Point Cache 2, little endian) and .mdd (LightWave, big endian, with `times` in s).
void write_pc2(const std::vector<Floats3>& frames, const std::filesystem::path& file);
void write_mdd(const std::vector<Floats3>& frames, std::span<const double> times, const std::filesystem::path& file);

struct AnimatedMesh {
  PosedMesh first;                 // the first frame; gets smooth normals if its rest mesh has none
  std::vector<Floats3> positions;  // per frame, n x 3, m
  std::vector<Floats3> normals;    // per frame, n x 3, unit
};

/// Players keep an image per morph target, and the weights grow with the square of their number: longer films should
/// be thinned out.
inline constexpr std::size_t kMaxTargets = 250;

enum class GlbPrecision { kFloat, kQuantized };  // kQuantized: half the bytes, see add_quantized() in glb_buffer.h

/// One glTF 2 file (.glb): each mesh in its first frame, one morph target (positions and normals) per later frame, and
/// an animation of their weights, linear between frames. (assimp drops such animations.) `times`: s, ascending. Returns
/// the largest error of a coordinate (m) beyond the rounding of floats. Throws Error(kBadInput) if the file would
/// exceed the format's 4 GB.
double write_animated_glb(const std::vector<AnimatedMesh>& meshes, const std::vector<double>& times,
                          const std::filesystem::path& file, GlbPrecision precision = GlbPrecision::kFloat);

/// The bytes of a .glb with a single frame.
[[nodiscard]] std::string static_glb(const std::vector<PosedMesh>& meshes);

/// One stage of USD in text (.usda, version 1.0): each mesh with time samples of its points and normals, its UVs, its
/// colours, and for each of its parts a subset of its faces and, unless it has colours, a UsdPreviewSurface; Y up,
/// metres, textures beside the file. Times (s, ascending) become time codes by `fps`: frame 1 is the one at 0 s. By the
/// text format of OpenUSD (openusd.org/release/spec_usdpreviewsurface.html and its schemas UsdGeomMesh and
/// UsdGeomSubset).
void write_usda(const std::vector<AnimatedMesh>& meshes, std::span<const double> times, double fps,
                const std::filesystem::path& file);

}  // namespace sprung
