#include "core/mesh/read/mesh_bytes.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/error.h"

namespace sprung {
namespace {

class Writer {
 public:
  template <class Value>
  requires std::is_arithmetic_v<Value>
  void put(const Value& value) { append(&value, sizeof value); }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    append(text.data(), text.size());
  }
  void put(const std::vector<std::byte>& bytes) {
    put(std::uint64_t{bytes.size()});
    append(bytes.data(), bytes.size());
  }
  template <class Scalar, int columns>
  void put(const Eigen::Matrix<Scalar, Eigen::Dynamic, columns, Eigen::RowMajor>& rows) {
    put(static_cast<std::uint64_t>(rows.rows()));
    append(rows.data(), sizeof(Scalar) * static_cast<std::size_t>(rows.size()));
  }
  void put(const Part& part) {
    put(part.name);
    put(part.first_triangle);
    put(part.triangle_count);
    put(part.material);
  }
  void put(const SurfaceMaterial& material) {
    put(material.name);
    for (const float channel : material.color) put(channel);
    put(material.texture);
    put(material.texture_name);
  }
  template <class Item>
  requires(!std::is_arithmetic_v<Item> && !std::is_same_v<Item, std::byte>) void put(const std::vector<Item>& items) {
    put(std::uint64_t{items.size()});
    for (const Item& item : items) put(item);
  }
  std::vector<std::byte> finish() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
  }

  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class Value>
  requires std::is_arithmetic_v<Value>
  void get(Value& value) { take(&value, sizeof value); }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    value = byte != 0;
  }
  void get(std::string& text) {
    text.resize(take_count(1));
    take(text.data(), text.size());
  }
  void get(std::vector<std::byte>& bytes) {
    bytes.resize(take_count(1));
    take(bytes.data(), bytes.size());
  }
  template <class Scalar, int columns>
  void get(Eigen::Matrix<Scalar, Eigen::Dynamic, columns, Eigen::RowMajor>& rows) {
    rows.resize(static_cast<Eigen::Index>(take_count(sizeof(Scalar) * columns)), columns);
    take(rows.data(), sizeof(Scalar) * static_cast<std::size_t>(rows.size()));
  }
  void get(Part& part) {
    get(part.name);
    get(part.first_triangle);
    get(part.triangle_count);
    get(part.material);
  }
  void get(SurfaceMaterial& material) {
    get(material.name);
    for (float& channel : material.color) get(channel);
    get(material.texture);
    get(material.texture_name);
  }
  template <class Item>
  requires(!std::is_arithmetic_v<Item> && !std::is_same_v<Item, std::byte>) void get(std::vector<Item>& items) {
    items.resize(take_count(sizeof(std::uint64_t)));  // each item begins with the length of a string
    for (Item& item : items) get(item);
  }
  void check_end() const {
    if (!left_.empty()) refuse();
  }

 private:
  [[noreturn]] static void refuse() { throw Error(ErrorKind::kFailed, "the reader of meshes gave no whole mesh"); }

  std::size_t take_count(std::size_t least_size) {
    std::uint64_t count = 0;
    get(count);
    if (count > left_.size() / least_size) refuse();
    return count;
  }

  void take(void* data, std::size_t size) {
    if (size > left_.size()) refuse();
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_ = left_.subspan(size);
  }

  std::span<const std::byte> left_;
};

/// Visits the fields in one order, for both ways.
template <class Visitor, class Mesh>
void visit(Mesh& mesh, const Visitor& field) {
  field(mesh.positions);
  field(mesh.triangles);
  field(mesh.normals);
  field(mesh.uvs);
  field(mesh.colors);
  field(mesh.parts);
  field(mesh.materials);
  field(mesh.notes);
  field(mesh.single_precision);
}

bool covers_triangles(const SurfaceMesh& mesh) {
  std::int64_t next = 0;
  for (const Part& part : mesh.parts) {
    const bool is_known = part.material >= -1 && part.material < std::ssize(mesh.materials);
    if (part.first_triangle != next || part.triangle_count <= 0 || !is_known) return false;
    next += part.triangle_count;
  }
  return next == mesh.triangles.rows();
}

}  // namespace

std::vector<std::byte> bytes_from_mesh(const SurfaceMesh& mesh) {
  Writer writer;
  visit(mesh, [&](const auto& field) { writer.put(field); });
  return writer.finish();
}

SurfaceMesh mesh_from_bytes(std::span<const std::byte> bytes) {
  SurfaceMesh mesh;
  Reader reader(bytes);
  visit(mesh, [&](auto& field) { reader.get(field); });
  reader.check_end();
  return mesh;
}

std::string find_fault(const SurfaceMesh& mesh) {
  const Eigen::Index vertices = mesh.positions.rows();
  for (Eigen::Index v = 0; v < vertices; ++v) {
    if (!mesh.positions.row(v).allFinite()) return fmt::format("vertex {} has a coordinate that is not finite", v + 1);
  }
  if (mesh.triangles.rows() == 0) {
    return vertices > 0 ? fmt::format("no faces (a point cloud); it holds {} points", vertices) : "no faces";
  }
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto row = mesh.triangles.row(t);
    if (row.minCoeff() < 0 || row.maxCoeff() >= vertices) {
      return fmt::format("triangle {} refers to vertex {} of {}, counted from 1 (index out of range)", t + 1,
                         row.minCoeff() < 0 ? row.minCoeff() : row.maxCoeff() + 1L, vertices);
    }
  }
  const auto fits = [&](const auto& rows) { return rows.rows() == 0 || rows.rows() == vertices; };
  if (!fits(mesh.normals) || !fits(mesh.uvs) || !fits(mesh.colors)) return "its normals, UVs or colours do not fit";
  if (!mesh.normals.allFinite() || !mesh.uvs.allFinite() || !mesh.colors.allFinite())
    return "a normal, a UV or a colour is not finite";
  return covers_triangles(mesh) ? "" : "its parts do not cover its triangles";
}

}  // namespace sprung
