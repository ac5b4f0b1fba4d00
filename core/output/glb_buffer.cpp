#include "core/output/glb_buffer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace sprung {
namespace {

constexpr int kByte = 5120;
constexpr int kShort = 5122;
constexpr int kFloat = 5126;
constexpr int kUnsigned = 5125;

template <class Row>
std::string list_of(const Row& row) {
  std::vector<float> values(row.begin(), row.end());
  return fmt::format("[{:.9g}]", fmt::join(values, ","));
}

/// Rows of four: vertices begin at multiples of four bytes.
template <class Value>
Eigen::Matrix<Value, Eigen::Dynamic, 4, Eigen::RowMajor> padded(
    const Eigen::Matrix<Value, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
  Eigen::Matrix<Value, Eigen::Dynamic, 4, Eigen::RowMajor> wide(rows.rows(), 4);
  wide << rows, Eigen::Matrix<Value, Eigen::Dynamic, 1>::Zero(rows.rows());
  return wide;
}

template <class Matrix>
std::size_t size_of(const Matrix& rows) {
  return static_cast<std::size_t>(rows.size()) * sizeof(float);
}

}  // namespace

int GlbBuffer::add_view(const void* data, std::size_t size, Use use, std::size_t stride) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  const std::string target = use == Use::kOther ? "" : fmt::format(",\"target\":{}", static_cast<int>(use));
  const std::string apart = stride == 0 ? "" : fmt::format(",\"byteStride\":{}", stride);
  views_.push_back(
      fmt::format("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}{}{}}}", bytes_.size(), size, apart, target));
  bytes_.append(static_cast<const char*>(data), size);
  return static_cast<int>(views_.size()) - 1;
}

int GlbBuffer::add_accessor(int view, const char* type, int component, std::size_t count, const std::string& bounds) {
  accessors_.push_back(fmt::format("{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}", view,
                                   component, count, type, bounds));
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuffer::add_vectors(const Floats3& rows, bool with_bounds) {
  const int view = add_view(rows.data(), size_of(rows), Use::kVertices);
  std::string bounds;
  if (with_bounds) {
    const Eigen::RowVector3f low = rows.colwise().minCoeff();
    const Eigen::RowVector3f high = rows.colwise().maxCoeff();
    bounds = fmt::format(",\"min\":{},\"max\":{}", list_of(low), list_of(high));
  }
  return add_accessor(view, "VEC3", kFloat, static_cast<std::size_t>(rows.rows()), bounds);
}

int GlbBuffer::add_shorts(const Shorts3& rows) {
  const auto wide = padded(rows);
  const int view = add_view(wide.data(), static_cast<std::size_t>(wide.size()) * sizeof(std::int16_t), Use::kVertices,
                            4 * sizeof(std::int16_t));
  const std::string bounds = fmt::format(",\"min\":[{}],\"max\":[{}]", fmt::join(rows.colwise().minCoeff().eval(), ","),
                                         fmt::join(rows.colwise().maxCoeff().eval(), ","));
  return add_accessor(view, "VEC3", kShort, static_cast<std::size_t>(rows.rows()), bounds);
}

int GlbBuffer::add_bytes(const Bytes3& rows) {
  const auto wide = padded(rows);
  const int view = add_view(wide.data(), static_cast<std::size_t>(wide.size()), Use::kVertices, 4);
  return add_accessor(view, "VEC3", kByte, static_cast<std::size_t>(rows.rows()), ",\"normalized\":true");
}

int GlbBuffer::add_uvs(const Floats2& rows) {
  Floats2 down = rows;  // v runs down in glTF
  down.col(1) = 1.0F - down.col(1).array();
  const int view = add_view(down.data(), size_of(down), Use::kVertices);
  return add_accessor(view, "VEC2", kFloat, static_cast<std::size_t>(down.rows()), "");
}

int GlbBuffer::add_colors(const Floats4& rows) {
  const int view = add_view(rows.data(), size_of(rows), Use::kVertices);
  return add_accessor(view, "VEC4", kFloat, static_cast<std::size_t>(rows.rows()), "");
}

int GlbBuffer::add_indices(std::span<const int> indices) {
  const int view = add_view(indices.data(), indices.size_bytes(), Use::kIndices);
  return add_accessor(view, "SCALAR", kUnsigned, indices.size(), "");
}

int GlbBuffer::add_scalars(std::span<const float> values, bool with_bounds) {
  const int view = add_view(values.data(), values.size_bytes(), Use::kOther);
  std::string bounds;
  if (with_bounds) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    bounds = fmt::format(",\"min\":[{:.9g}],\"max\":[{:.9g}]", *low, *high);
  }
  return add_accessor(view, "SCALAR", kFloat, values.size(), bounds);
}

int GlbBuffer::add_picture(std::span<const std::byte> bytes) {
  return add_view(bytes.data(), bytes.size(), Use::kOther);
}

std::string GlbBuffer::json() const {
  return fmt::format("\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]",
                     fmt::join(accessors_, ","), fmt::join(views_, ","), bytes_.size());
}

}  // namespace sprung
