#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/io/mesh_export.h"
#include "core/skin/skin.h"

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

using Shorts3 = Eigen::Matrix<std::int16_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Bytes3 = Eigen::Matrix<std::int8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The numbers of a glTF file and the JSON that says where in them what lies.
class GlbBuffer {
 public:
  enum class Use { kVertices = 34962, kIndices = 34963, kOther = 0 };

  /// Each returns the number of its accessor.
  int add_vectors(const Floats3& rows, bool with_bounds);
  /// With bounds.
  int add_shorts(const Shorts3& rows);
  /// That count as shares of 127.
  int add_bytes(const Bytes3& rows);
  int add_uvs(const Floats2& rows);
  int add_colors(const Floats4& rows);
  int add_indices(std::span<const int> indices);
  int add_scalars(std::span<const float> values, bool with_bounds);
  /// The number of its view: a picture.
  int add_picture(std::span<const std::byte> bytes);

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// "accessors": [...], "bufferViews": [...], "buffers": [...]
  [[nodiscard]] std::string json() const;

 private:
  int add_view(const void* data, std::size_t size, Use use, std::size_t stride = 0);
  int add_accessor(int view, const char* type, int component, std::size_t count, const std::string& bounds);

  std::string bytes_;
  std::vector<std::string> views_;
  std::vector<std::string> accessors_;
};

/// Where in a buffer the vertices of a film are: accessors of the first frame, then of what later ones add to it.
struct GlbVertices {
  std::vector<int> positions;
  std::vector<int> normals;
  std::string placement;  // ",\"scale\":[...]..." of the node that has the mesh; "": none
  double error = 0;       // m: a coordinate is off by at most this
};

/// Floats.
[[nodiscard]] GlbVertices add_floats(GlbBuffer& buffer, const AnimatedMesh& mesh);

/// Positions as multiples of a step, of 16 bits: in no frame off by more than half of it. A normal is added as
/// s n - n_0, which turns n_0 into the direction of n whatever s > 0 is: where that fits into [-1, 1] with s >= 1/4 at
/// all vertices of a frame, normals have 8 bits and are off by at most 1.6 degrees, else they are floats.
/// By the extension KHR_mesh_quantization.
[[nodiscard]] GlbVertices add_quantized(GlbBuffer& buffer, const AnimatedMesh& mesh);

}  // namespace sprung
