#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of a number in a binary file.
[[nodiscard]] std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  // of the number, or of those in the list
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of the length of a list
};

struct PlyElement {
  std::string name;
  long count = 0;
  std::vector<PlyProperty> properties;

  /// The place of the first property of one of these names; -1 where there is none.
  [[nodiscard]] int find(std::initializer_list<std::string_view> names) const;
};

enum class PlyFormat { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kText;
  std::vector<PlyElement> elements;  // in the order of their data
  std::string texture;               // of a comment "TextureFile name"; empty: none
  std::size_t size = 0;              // bytes, the line end after end_header included
  long lines = 0;
};

/// The header of a PLY file, checked: no element can have more entries than the bytes after the header can hold.
/// Throws Error(kBadInput) with the line.
[[nodiscard]] PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace sprung
