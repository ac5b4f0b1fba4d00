#include "core/output/glb_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sprung {
namespace {

constexpr float kMostShort = 32766;  // one less than there is: differences of rounded numbers may gain one
constexpr float kMostByte = 127;
constexpr float kLeastLength = 0.25F;

using Numbers3 = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Whole numbers in place of positions: of those at origin + step * numbers.
struct Lattice {
  Eigen::RowVector3f origin;
  float step = 1;

  [[nodiscard]] Numbers3 numbers_at(const Floats3& positions) const {
    return ((positions.rowwise() - origin) / step).array().round().cast<int>();
  }
};

/// The coarsest that the first frame needs around its middle, or the way of any vertex from there.
Lattice lattice_of(const std::vector<Floats3>& positions) {
  const Floats3& first = positions.front();
  const Eigen::RowVector3f low = first.colwise().minCoeff();
  const Eigen::RowVector3f high = first.colwise().maxCoeff();
  float reach = 0.5F * (high - low).maxCoeff();
  for (const Floats3& later : positions) reach = std::max(reach, (later - first).cwiseAbs().maxCoeff());
  return {.origin = 0.5F * (low + high), .step = reach > 0 ? reach / kMostShort : 1};
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

Bytes3 bytes_of(const Floats3& normals) { return (kMostByte * normals).array().round().cast<std::int8_t>(); }

/// What turns the base into these normals; nothing where it does not fit.
std::optional<Bytes3> turns_to(const Floats3& normals, const Floats3& base) {
  Floats3 turns(normals.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const float length = fitting_length(normals.row(i), base.row(i));
    if (length < kLeastLength) return std::nullopt;
    turns.row(i) = length * normals.row(i) - base.row(i);
  }
  return bytes_of(turns);
}

}  // namespace

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
  const Numbers3 first = lattice.numbers_at(mesh.positions.front());
  const Bytes3 base_bytes = bytes_of(mesh.normals.front());
  const Floats3 base = base_bytes.cast<float>() / kMostByte;
  GlbVertices vertices;
  vertices.positions = {buffer.add_shorts(first.cast<std::int16_t>())};
  vertices.normals = {buffer.add_bytes(base_bytes)};
  for (std::size_t frame = 1; frame < mesh.positions.size(); ++frame) {
    // In whole numbers, so that the later frame is rounded only once.
    vertices.positions.push_back(
        buffer.add_shorts((lattice.numbers_at(mesh.positions[frame]) - first).cast<std::int16_t>()));
    const std::optional<Bytes3> turns = turns_to(mesh.normals[frame], base);
    vertices.normals.push_back(turns ? buffer.add_bytes(*turns)
                                     : buffer.add_vectors(mesh.normals[frame] - base, false));
  }
  const Eigen::RowVector3f& origin = lattice.origin;
  vertices.placement = fmt::format(",\"translation\":[{0:.9g},{1:.9g},{2:.9g}],\"scale\":[{3:.9g},{3:.9g},{3:.9g}]",
                                   origin.x(), origin.y(), origin.z(), lattice.step);
  vertices.error = 0.5 * static_cast<double>(lattice.step);
  return vertices;
}

}  // namespace sprung
