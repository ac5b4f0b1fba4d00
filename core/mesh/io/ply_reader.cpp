#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/mesh/io/polygon_soup.h"
#include "core/mesh/io/readers.h"
#include "core/mesh/io/text_scanner.h"

namespace sprung {
namespace {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of a number in a binary file.
std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[std::size_t(type)];
}

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

  /// The index of the first property with one of these names; -1: none.
  [[nodiscard]] int find(std::initializer_list<std::string_view> names) const;
};

enum class PlyFormat { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kText;
  std::vector<PlyElement> elements;  // in the order of their data
  std::string texture;               // of a comment "TextureFile name"; empty: none
  std::size_t size = 0;              // bytes, including the line end after end_header
  long lines = 0;
};

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

  /// Reads the next entry of an element; `what` names it in messages. Throws Error(kBadInput) for truncated data, a
  /// malformed number or an invalid list length.
  void read(const PlyElement& element, const Named& what, PlyEntry& entry);

  /// Throws Error(kBadInput), with the line for text files.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  double take(PlyType type, const Named& what);
  double take_binary(PlyType type, const Named& what);

  PlyFormat format_;
  std::string name_;
  std::string_view left_;  // of binary data
  TextScanner scanner_;
};

std::optional<PlyType> type_of(std::string_view word) {
  static const std::map<std::string_view, PlyType> kTypes{
      {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
      {"float64", PlyType::kFloat64}};
  const auto found = kTypes.find(word);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

/// The end of the header: after the line that consists of 'end_header', including its line end.
std::size_t find_end(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kEnd = "end_header";
  const std::string_view head = bytes.substr(0, std::size_t{1} << 20);
  for (std::size_t at = head.find(kEnd); at != std::string_view::npos; at = head.find(kEnd, at + 1)) {
    const std::size_t after = at + kEnd.size();
    const bool begins_line = at > 0 && (bytes[at - 1] == '\n' || bytes[at - 1] == '\r');
    if (!begins_line) continue;
    if (bytes.substr(after).starts_with("\r\n")) return after + 2;
    if (after < bytes.size() && (bytes[after] == '\n' || bytes[after] == '\r')) return after + 1;
  }
  throw Error(ErrorKind::kBadInput, name + ": the PLY header has no 'end_header': the file is cut short");
}

void read_format(TextScanner& scanner, PlyHeader& header) {
  static const std::map<std::string_view, PlyFormat> kFormats{{"ascii", PlyFormat::kText},
                                                              {"binary_little_endian", PlyFormat::kLittleEndian},
                                                              {"binary_big_endian", PlyFormat::kBigEndian}};
  const std::string_view word = scanner.word();
  const auto found = kFormats.find(word);
  if (found == kFormats.end())
    scanner.refuse("the format is neither ascii nor binary_little_endian nor binary_big_endian");
  header.format = found->second;
}

void read_element(TextScanner& scanner, PlyHeader& header) {
  PlyElement& element = header.elements.emplace_back();
  element.name = scanner.word();
  const auto count = number_of(scanner.word());
  if (!count || !(*count >= 0 && *count < 0x1p53)) {
    scanner.refuse(fmt::format("the element '{}' has no count", element.name));
  }
  element.count = long(*count);
}

void read_property(TextScanner& scanner, PlyHeader& header) {
  if (header.elements.empty()) scanner.refuse("a property stands before the first element");
  PlyProperty property;
  std::string_view word = scanner.word();
  property.is_list = word == "list";
  const auto take_type = [&] {
    const auto type = type_of(word);
    if (!type) scanner.refuse(fmt::format("'{}' is not a type of PLY", word));
    word = scanner.word();
    return *type;
  };
  if (property.is_list) {
    word = scanner.word();
    property.count_type = take_type();
  }
  property.type = take_type();
  property.name = word;
  header.elements.back().properties.push_back(std::move(property));
}

/// The minimum size of an entry of the element, bytes.
std::size_t min_bytes(const PlyElement& element, PlyFormat format) {
  if (format == PlyFormat::kText) return 2 * element.properties.size();
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += size_of(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

void check_counts(const PlyHeader& header, std::size_t body, const std::string& name) {
  for (const PlyElement& element : header.elements) {
    const double least = double(std::max<std::size_t>(1, min_bytes(element, header.format)));
    if (double(element.count) * least <= double(body) + 1) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: header declares {} of '{}', more than the file can hold ({} bytes after the header)",
                            name, element.count, element.name, body));
  }
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return int(i);
  }
  return -1;
}

/// Reads and checks the header of a PLY file: no element may have more entries than the bytes after the header can
/// hold. Throws Error(kBadInput) with the line.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("ply")) {
    throw Error(ErrorKind::kBadInput, name + ": is not a PLY file (it does not begin with 'ply')");
  }
  PlyHeader header;
  header.size = find_end(bytes, name);
  TextScanner scanner(bytes.substr(0, header.size), name);
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword == "format") read_format(scanner, header);
    if (keyword == "element") read_element(scanner, header);
    if (keyword == "property") read_property(scanner, header);
    if (keyword == "comment" && scanner.word() == "TextureFile") header.texture = scanner.rest();
  }
  header.lines = scanner.line();
  check_counts(header, bytes.size() - header.size, name);
  return header;
}

/// A number from its bytes in native order.
template <class Number>
double decode(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

double decode(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::kInt8:
      return decode<std::int8_t>(bytes);
    case PlyType::kUint8:
      return decode<std::uint8_t>(bytes);
    case PlyType::kInt16:
      return decode<std::int16_t>(bytes);
    case PlyType::kUint16:
      return decode<std::uint16_t>(bytes);
    case PlyType::kInt32:
      return decode<std::int32_t>(bytes);
    case PlyType::kUint32:
      return decode<std::uint32_t>(bytes);
    case PlyType::kFloat32:
      return decode<float>(bytes);
    case PlyType::kFloat64:
      return decode<double>(bytes);
  }
  return 0;
}

std::string_view text_part(std::string_view bytes, const PlyHeader& header) {
  return header.format == PlyFormat::kText ? bytes.substr(header.size) : std::string_view{};
}

PlyData::PlyData(std::string_view bytes, const PlyHeader& header, const std::string& name)
    : format_(header.format),
      name_(name),
      left_(bytes.substr(header.size)),
      scanner_(text_part(bytes, header), name, header.lines) {}

double PlyData::take_binary(PlyType type, const Named& what) {
  const std::size_t size = size_of(type);
  if (left_.size() < size) refuse(fmt::format("the file ends before {}: it is cut short", what.text()));
  char bytes[8];
  std::copy_n(left_.data(), size, bytes);
  left_.remove_prefix(size);
  const bool is_native = (format_ == PlyFormat::kLittleEndian) == (std::endian::native == std::endian::little);
  if (!is_native) std::reverse(bytes, bytes + size);
  return decode(type, bytes);
}

double PlyData::take(PlyType type, const Named& what) {
  return format_ == PlyFormat::kText ? scanner_.number_ahead(what) : take_binary(type, what);
}

void PlyData::read(const PlyElement& element, const Named& what, PlyEntry& entry) {
  entry.numbers.resize(element.properties.size());
  entry.lists.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.is_list) {
      entry.numbers[i] = take(property.type, what);
      continue;
    }
    const double length = take(property.count_type, what);
    if (!(length >= 0) || length != std::floor(length)) refuse(fmt::format("{} has a list of {}", what.text(), length));
    entry.lists[i].clear();
    for (double k = 0; k < length; ++k) entry.lists[i].push_back(take(property.type, what));
  }
}

void PlyData::refuse(const std::string& reason) const {
  if (format_ == PlyFormat::kText) scanner_.refuse(reason);
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name_, reason));
}

/// The attributes of a vertex by the indices of their properties; -1: missing.
struct VertexIndices {
  explicit VertexIndices(const PlyElement& element)
      : position{element.find({"x"}), element.find({"y"}), element.find({"z"})},
        normal{element.find({"nx", "normal_x"}), element.find({"ny", "normal_y"}), element.find({"nz", "normal_z"})},
        uv{element.find({"u", "s", "texture_u", "texture_s", "tx"}),
           element.find({"v", "t", "texture_v", "texture_t", "ty"})},
        color{element.find({"red", "diffuse_red", "r"}), element.find({"green", "diffuse_green", "g"}),
              element.find({"blue", "diffuse_blue", "b"})},
        alpha(element.find({"alpha", "diffuse_alpha", "a"})) {}

  std::array<int, 3> position;
  std::array<int, 3> normal;
  std::array<int, 2> uv;
  std::array<int, 3> color;
  int alpha;
};

template <std::size_t n>
bool has_all(const std::array<int, n>& places) {
  return std::all_of(places.begin(), places.end(), [](int index) { return index >= 0; });
}

/// Integer colours have 8 or 16 bits.
double full_scale(PlyType type) {
  if (type == PlyType::kFloat32 || type == PlyType::kFloat64) return 1;
  return type == PlyType::kUint16 ? 65535 : 255;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name)
      : name_(name), header_(read_ply_header(bytes, name)), data_(bytes, header_, name) {
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex") continue;
      if (vertices_ >= 0) data_.refuse("has more than one element 'vertex'");
      vertices_ = element.count;
    }
    soup_.parts.push_back({.name = std::filesystem::path(name).stem().string()});
    if (!header_.texture.empty()) {
      SurfaceMaterial& material = soup_.materials.emplace_back();
      material.name = "texture";
      material.color.setOnes();
      material.texture_name = header_.texture;
      soup_.parts[0].material = 0;
    }
  }

  SurfaceMesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else if (element.name == "tristrips") {
        read_strips(element);
      } else {
        if (element.name == "edge") soup_.lines = element.count;
        read_all(element, [](const Named&) {});
      }
    }
    // Where faces precede the vertices, the vertex attributes are not known yet.
    for (Corner& corner : soup_.corners) {
      if (has_vertex_uvs_ && corner.uv < 0) corner.uv = corner.position;
      if (has_normals_) corner.normal = corner.position;
    }
    return mesh_from(std::move(soup_), name_);
  }

 private:
  template <class Use>
  void read_all(const PlyElement& element, const Use& use) {
    for (long i = 0; i < element.count; ++i) {
      const Named what{element.name, i + 1};
      data_.read(element, what, entry_);
      use(what);
    }
  }

  [[nodiscard]] double number(int place) const { return entry_.numbers[place]; }

  void read_vertices(const PlyElement& element) {
    const VertexIndices places(element);
    if (!has_all(places.position)) data_.refuse("its vertices have no x, y and z");
    has_normals_ = has_all(places.normal);
    has_vertex_uvs_ = has_all(places.uv) && !has_corner_uvs();
    const auto type = [&](int place) { return element.properties[place].type; };
    soup_.single_precision = header_.format != PlyFormat::kText && type(places.position[0]) == PlyType::kFloat32;
    const double scale = has_all(places.color) ? full_scale(type(places.color[0])) : 1;
    read_all(element, [&](const Named&) {
      const auto& p = places.position;
      add_position(soup_, {number(p[0]), number(p[1]), number(p[2])}, name_);
      const auto& n = places.normal;
      if (has_normals_) add_normal(soup_, {number(n[0]), number(n[1]), number(n[2])});
      if (has_vertex_uvs_) add_uv(soup_, {number(places.uv[0]), number(places.uv[1])});
      if (has_all(places.color)) add_color(places, scale);
    });
  }

  void add_color(const VertexIndices& places, double scale) {
    Eigen::Vector4d color(number(places.color[0]), number(places.color[1]), number(places.color[2]),
                          places.alpha < 0 ? scale : number(places.alpha));
    color /= scale;
    if (!color.allFinite()) color.setOnes();
    soup_.colors.emplace_back(color.cwiseMax(0).cwiseMin(1).cast<float>());
  }

  [[nodiscard]] bool has_corner_uvs() const {
    return std::any_of(header_.elements.begin(), header_.elements.end(), [](const PlyElement& element) {
      return element.name == "face" && element.find({"texcoord", "texture_coordinates"}) >= 0;
    });
  }

  int row_of(double vertex, const Named& what) const {
    if (vertex >= 0 && vertex < double(vertices_) && vertex == std::floor(vertex)) {
      return int(vertex);
    }
    data_.refuse(fmt::format("{} refers to vertex {}, but they run from 0 to {} (index out of range)", what.text(),
                             vertex, vertices_ - 1));
  }

  void add_polygon(std::span<const double> vertices, std::span<const double> uvs, const Named& what) {
    if (vertices.size() < 3) return;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      Corner corner{.position = row_of(vertices[i], what)};
      if (uvs.size() == 2 * vertices.size()) {
        corner.uv = isize(soup_.uvs);
        add_uv(soup_, {uvs[2 * i], uvs[2 * i + 1]});
      }
      soup_.corners.push_back(corner);
    }
    soup_.corner_counts.push_back(isize(vertices));
    soup_.polygon_parts.push_back(0);
  }

  int list_place(const PlyElement& element) {
    const int place = element.find({"vertex_indices", "vertex_index"});
    if (place < 0 || !element.properties[place].is_list) {
      data_.refuse(fmt::format("the element '{}' has no list of vertex_indices", element.name));
    }
    return place;
  }

  void read_faces(const PlyElement& element) {
    if (element.count == 0) return;
    const std::size_t vertices = list_place(element);
    const int uvs = element.find({"texcoord", "texture_coordinates"});
    read_all(element, [&](const Named& what) {
      std::span<const double> corner_uvs;
      if (uvs >= 0) corner_uvs = entry_.lists[uvs];
      add_polygon(entry_.lists[vertices], corner_uvs, what);
    });
  }

  /// Each vertex of a strip forms a triangle with the two before it, alternately flipped; -1 restarts the strip.
  void read_strips(const PlyElement& element) {
    if (element.count == 0) return;
    const std::size_t place = list_place(element);
    read_all(element, [&](const Named& what) {
      const std::vector<double>& strip = entry_.lists[place];
      std::size_t begin = 0;
      for (std::size_t i = 0; i < strip.size(); ++i) {
        if (strip[i] == -1) begin = i + 1;
        if (i < begin + 2) continue;
        const bool is_even = (i - begin) % 2 == 0;
        const std::array triangle{strip[is_even ? i - 2 : i - 1], strip[is_even ? i - 1 : i - 2], strip[i]};
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
          add_polygon(triangle, {}, what);
        }
      }
    });
  }

  const std::string& name_;
  PlyHeader header_;
  PlyData data_;
  PlyEntry entry_;
  PolygonSoup soup_;
  long vertices_ = -1;  // none declared yet
  bool has_normals_ = false;
  bool has_vertex_uvs_ = false;
};

}  // namespace

SurfaceMesh read_ply(std::string_view bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

}  // namespace sprung
