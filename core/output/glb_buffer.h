#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

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

}  // namespace sprung
