#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/io/animation.h"

/// The binary part of a glTF 2 file.
namespace sprung {

using GltfJson = nlohmann::ordered_json;

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
  /// Adds "accessors", "bufferViews" and "buffers" to a glTF document.
  void describe(GltfJson& document) const;

 private:
  int add_view(const void* data, std::size_t size, Use use, std::size_t stride = 0);
  int add_accessor(int view, const char* type, int component, std::size_t count, const GltfJson& more = {});

  std::string bytes_;
  GltfJson views_ = GltfJson::array();
  GltfJson accessors_ = GltfJson::array();
};

/// The vertices of an animation in a buffer: accessors of the first frame, then of the morph targets.
struct GlbVertices {
  std::vector<int> positions;
  std::vector<int> normals;
  GltfJson transform = GltfJson::object();  // "translation" and "scale" for the node that has the mesh, or nothing
  double error = 0;                         // m, largest of a coordinate
};

[[nodiscard]] GlbVertices add_floats(GlbBuffer& buffer, const AnimatedMesh& mesh);

/// By KHR_mesh_quantization. Positions are multiples of a step, 16 bits, off by at most half of it in every frame. A
/// normal's target is s n - n_0, which takes n_0 to the direction of n for any s > 0: if that fits into [-1, 1] with s
/// >= 1/4 at all vertices of a frame, normals have 8 bits and are off by at most 1.6 degrees, else floats.
[[nodiscard]] GlbVertices add_quantized(GlbBuffer& buffer, const AnimatedMesh& mesh);

}  // namespace sprung
