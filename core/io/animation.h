#pragma once
#include <cstddef>
#include <cstdint>
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
inline constexpr std::size_t kMostTargets = 250;

enum class GlbPrecision { kFloat, kQuantized };  // kQuantized: half the bytes, see add_quantized()

/// One glTF 2 file (.glb): each mesh in its first frame, one morph target (positions and normals) per later frame, and
/// an animation of their weights, linear between frames. (assimp drops such animations.)
/// `times`: s, ascending. Returns the largest error of a coordinate (m) beyond the rounding of floats.
/// Throws Error(kBadInput) where the file would exceed the format's 4 GB.
double write_animated_glb(const std::vector<AnimatedMesh>& meshes, const std::vector<double>& times,
                          const std::filesystem::path& file, GlbPrecision precision = GlbPrecision::kFloat);

/// The bytes of a .glb with a single frame.
[[nodiscard]] std::string static_glb(const std::vector<PosedMesh>& meshes);

using Shorts3 = Eigen::Matrix<std::int16_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Bytes3 = Eigen::Matrix<std::int8_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The binary buffer of a glTF file with the buffer views and accessors into it.
class GlbBuffer {
 public:
  enum class Use { kVertices = 34962, kIndices = 34963, kOther = 0 };

  /// Each returns the index of a new accessor. `with_bounds`: with minimum and maximum.
  int add_vectors(const Floats3& rows, bool with_bounds);
  int add_shorts(const Shorts3& rows);  // with bounds
  int add_bytes(const Bytes3& rows);    // normalized: multiples of 1/127
  int add_uvs(const Floats2& rows);
  int add_colors(const Floats4& rows);
  int add_indices(std::span<const int> indices);
  int add_scalars(std::span<const float> values, bool with_bounds);
  /// Returns the index of a new buffer view that holds an encoded image.
  int add_image(std::span<const std::byte> bytes);

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

/// The vertices of an animation in a buffer: accessors of the first frame, then of the morph targets.
struct GlbVertices {
  std::vector<int> positions;
  std::vector<int> normals;
  std::string transform;  // ",\"scale\":[...]..." for the node that has the mesh; "": none
  double error = 0;       // m, largest of a coordinate
};

[[nodiscard]] GlbVertices add_floats(GlbBuffer& buffer, const AnimatedMesh& mesh);

/// By KHR_mesh_quantization. Positions are multiples of a step, 16 bits, off by at most half of it in every frame.
/// A normal's target is s n - n_0, which takes n_0 to the direction of n for any s > 0: where that fits into [-1, 1]
/// with s >= 1/4 at all vertices of a frame, normals have 8 bits and are off by at most 1.6 degrees, else floats.
[[nodiscard]] GlbVertices add_quantized(GlbBuffer& buffer, const AnimatedMesh& mesh);

}  // namespace sprung
