#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/text_scanner.h"

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

/// The values of one vertex, face or the like, by property: a number or a list.
struct PlyEntry {
  std::vector<double> numbers;
  std::vector<std::vector<double>> lists;
};

/// The data of a PLY file after its header, entry by entry.
class PlyData {
 public:
  /// `bytes`: of the whole file, which must outlive this.
  PlyData(std::string_view bytes, const PlyHeader& header, const std::string& name);

  /// Reads the next entry of an element; `what` names it in messages. Throws Error(kBadInput) where the data end, or
  /// hold no number or a list of no possible length.
  void read(const PlyElement& element, const Named& what, PlyEntry& entry);

  /// Throws Error(kBadInput), with the line in a text.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  double take(PlyType type, const Named& what);
  double take_binary(PlyType type, const Named& what);

  PlyFormat format_;
  std::string name_;
  std::string_view left_;  // of binary data
  TextScanner scanner_;
};

}  // namespace sprung
