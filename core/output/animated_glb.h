#pragma once
#include <filesystem>
#include <vector>

#include "core/output/posed_mesh.h"

namespace sprung {

/// A film as one glTF 2 file (.glb): every mesh at its first frame, with a morph target (positions and normals) for
/// each later one and an animation of their weights, evenly from frame to frame. Everything that plays glTF plays it.
/// assimp drops such animations, so this writes the file itself.
struct AnimatedMesh {
  PosedMesh first;                 // without normals in its rest mesh it gets smooth ones
  std::vector<Floats3> positions;  // of every frame, n x 3, m
  std::vector<Floats3> normals;    // likewise, unit
};

/// Players keep a picture for each target, and the weights grow with the square of their number: from here on films
/// are to be thinned out.
inline constexpr std::size_t kMostTargets = 250;

/// How vertices are kept: as floats, or in half the bytes and less exactly (see add_quantized() in glb_vertices.h).
enum class GlbNumbers { kFloats, kQuantized };

/// `times` of the frames in s, rising. Written beside the name and renamed. Returns by how much coordinates are off at
/// most in any frame, m, beside the rounding of floats. Throws Error(kFailed), Error(kBadInput) where it would be
/// larger than the 4 GB that such files may have.
double write_animated_glb(const std::vector<AnimatedMesh>& meshes, const std::vector<double>& times,
                          const std::filesystem::path& file, GlbNumbers numbers = GlbNumbers::kFloats);

/// The bytes of such a file with one frame.
[[nodiscard]] std::string still_glb(const std::vector<PosedMesh>& meshes);

}  // namespace sprung
