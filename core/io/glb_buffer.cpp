#include "core/io/glb_buffer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sprung {
namespace {

constexpr int kByte = 5120;
constexpr int kShort = 5122;
constexpr int kFloat = 5126;
constexpr int kUnsigned = 5125;

constexpr float kMaxShort = 32766;  // one to spare for differences of rounded numbers
constexpr float kMaxByte = 127;
constexpr float kMinLength = 0.25F;  // of a scaled normal

template <class Row>
GltfJson json_list(const Row& row) {
  GltfJson list = GltfJson::array();
  for (const auto value : row) list.push_back(value);
  return list;
}

template <class Rows>
GltfJson bounds_of(const Rows& rows) {
  return {{"min", json_list(rows.colwise().minCoeff().eval())}, {"max", json_list(rows.colwise().maxCoeff().eval())}};
}

/// With a fourth column of zeros: vertices are aligned to four bytes.
template <class Value>
Eigen::Matrix<Value, Eigen::Dynamic, 4, Eigen::RowMajor> padded(
    const Eigen::Matrix<Value, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
  Eigen::Matrix<Value, Eigen::Dynamic, 4, Eigen::RowMajor> wide(rows.rows(), 4);
  wide << rows, Eigen::Matrix<Value, Eigen::Dynamic, 1>::Zero(rows.rows());
  return wide;
}

template <class Matrix>
std::size_t size_of(const Matrix& rows) {
  return std::size_t(rows.size()) * sizeof(float);
}

using Integers3 = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Quantized positions: origin + step * integers.
struct Lattice {
  Eigen::RowVector3f origin;
  float step = 1;

  [[nodiscard]] Integers3 quantize(const Floats3& positions) const {
    return ((positions.rowwise() - origin) / step).array().round().cast<int>();
  }
};

/// Covers the first frame around its centre, and the displacement of every vertex from it.
Lattice lattice_of(const std::vector<Floats3>& positions) {
  const Floats3& first = positions.front();
  const Eigen::RowVector3f low = first.colwise().minCoeff();
  const Eigen::RowVector3f high = first.colwise().maxCoeff();
  float reach = 0.5F * (high - low).maxCoeff();
  for (const Floats3& later : positions) reach = std::max(reach, (later - first).cwiseAbs().maxCoeff());
  return {.origin = 0.5F * (low + high), .step = reach > 0 ? reach / kMaxShort : 1};
}

/// The greatest length, at most 1, at which `normal` minus `base` has no component outside [-1, 1].
float fitting_length(const Eigen::RowVector3f& normal, const Eigen::RowVector3f& base) {
  float length = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] == 0) continue;
    length = std::min(length, (1 + std::copysign(1.0F, normal[axis]) * base[axis]) / std::abs(normal[axis]));
  }
  return length;
}

Bytes3 bytes_of(const Floats3& normals) { return (kMaxByte * normals).array().round().cast<std::int8_t>(); }

/// The targets that take the base to these normals; nothing if they do not fit.
std::optional<Bytes3> normal_targets(const Floats3& normals, const Floats3& base) {
  Floats3 targets(normals.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const float length = fitting_length(normals.row(i), base.row(i));
    if (length < kMinLength) return std::nullopt;
    targets.row(i) = length * normals.row(i) - base.row(i);
  }
  return bytes_of(targets);
}

}  // namespace

int GlbBuffer::add_view(const void* data, std::size_t size, Use use, std::size_t stride) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  GltfJson view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
  if (stride != 0) view["byteStride"] = stride;
  if (use != Use::kOther) view["target"] = int(use);
  views_.push_back(std::move(view));
  bytes_.append(static_cast<const char*>(data), size);
  return isize(views_) - 1;
}

int GlbBuffer::add_accessor(int view, const char* type, int component, std::size_t count, const GltfJson& more) {
  GltfJson accessor{{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
  if (!more.is_null()) accessor.update(more);
  accessors_.push_back(std::move(accessor));
  return isize(accessors_) - 1;
}

int GlbBuffer::add_vectors(const Floats3& rows, bool with_bounds) {
  const int view = add_view(rows.data(), size_of(rows), Use::kVertices);
  return add_accessor(view, "VEC3", kFloat, rows.rows(), with_bounds ? bounds_of(rows) : GltfJson());
}

int GlbBuffer::add_shorts(const Shorts3& rows) {
  const auto wide = padded(rows);
  const int view =
      add_view(wide.data(), std::size_t(wide.size()) * sizeof(std::int16_t), Use::kVertices, 4 * sizeof(std::int16_t));
  return add_accessor(view, "VEC3", kShort, rows.rows(), bounds_of(rows));
}

int GlbBuffer::add_bytes(const Bytes3& rows) {
  const auto wide = padded(rows);
  const int view = add_view(wide.data(), wide.size(), Use::kVertices, 4);
  return add_accessor(view, "VEC3", kByte, rows.rows(), {{"normalized", true}});
}

int GlbBuffer::add_uvs(const Floats2& rows) {
  Floats2 down = rows;  // v runs down in glTF
  down.col(1) = 1.0F - down.col(1).array();
  const int view = add_view(down.data(), size_of(down), Use::kVertices);
  return add_accessor(view, "VEC2", kFloat, down.rows());
}

int GlbBuffer::add_colors(const Floats4& rows) {
  const int view = add_view(rows.data(), size_of(rows), Use::kVertices);
  return add_accessor(view, "VEC4", kFloat, rows.rows());
}

int GlbBuffer::add_indices(std::span<const int> indices) {
  const int view = add_view(indices.data(), indices.size_bytes(), Use::kIndices);
  return add_accessor(view, "SCALAR", kUnsigned, indices.size());
}

int GlbBuffer::add_scalars(std::span<const float> values, bool with_bounds) {
  const int view = add_view(values.data(), values.size_bytes(), Use::kOther);
  GltfJson bounds;
  if (with_bounds) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    bounds = {{"min", {*low}}, {"max", {*high}}};
  }
  return add_accessor(view, "SCALAR", kFloat, values.size(), bounds);
}

int GlbBuffer::add_image(std::span<const std::byte> bytes) { return add_view(bytes.data(), bytes.size(), Use::kOther); }

void GlbBuffer::describe(GltfJson& document) const {
  document["accessors"] = accessors_;
  document["bufferViews"] = views_;
  document["buffers"] = {{{"byteLength", bytes_.size()}}};
}

GlbVertices add_floats(GlbBuffer& buffer, const AnimatedMesh& mesh) {
  GlbVertices vertices;
  vertices.positions = {buffer.add_vectors(mesh.positions.front(), true)};
  vertices.normals = {buffer.add_vectors(mesh.normals.front(), false)};
  for (std::size_t frame = 1; frame < mesh.positions.size(); ++frame) {
    vertices.positions.push_back(buffer.add_vectors(mesh.positions[frame] - mesh.positions.front(), true));
    vertices.normals.push_back(buffer.add_vectors(mesh.normals[frame] - mesh.normals.front(), false));
  }
  return vertices;
}

GlbVertices add_quantized(GlbBuffer& buffer, const AnimatedMesh& mesh) {
  const Lattice lattice = lattice_of(mesh.positions);
  const Integers3 first = lattice.quantize(mesh.positions.front());
  const Bytes3 base_bytes = bytes_of(mesh.normals.front());
  const Floats3 base = base_bytes.cast<float>() / kMaxByte;
  GlbVertices vertices;
  vertices.positions = {buffer.add_shorts(first.cast<std::int16_t>())};
  vertices.normals = {buffer.add_bytes(base_bytes)};
  for (std::size_t frame = 1; frame < mesh.positions.size(); ++frame) {
    // The difference of rounded positions, so that every frame is rounded only once.
    vertices.positions.push_back(
        buffer.add_shorts((lattice.quantize(mesh.positions[frame]) - first).cast<std::int16_t>()));
    const std::optional<Bytes3> targets = normal_targets(mesh.normals[frame], base);
    vertices.normals.push_back(targets ? buffer.add_bytes(*targets)
                                       : buffer.add_vectors(mesh.normals[frame] - base, false));
  }
  const Eigen::RowVector3f& origin = lattice.origin;
  vertices.transform = {{"translation", json_list(origin)}, {"scale", std::vector<float>(3, lattice.step)}};
  vertices.error = 0.5 * double(lattice.step);
  return vertices;
}

}  // namespace sprung
