#include "core/mesh/read/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/mesh/read/text_scanner.h"

namespace sprung {
namespace {

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

/// Where the header ends: after the line that holds nothing but 'end_header', line end included.
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
  element.count = static_cast<long>(*count);
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

/// The fewest bytes that an entry of the element takes.
std::size_t least_bytes(const PlyElement& element, PlyFormat format) {
  if (format == PlyFormat::kText) return 2 * element.properties.size();
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += size_of(property.is_list ? property.count_type : property.type);
  }
  return bytes;
}

void check_counts(const PlyHeader& header, std::size_t body, const std::string& name) {
  for (const PlyElement& element : header.elements) {
    const double least = static_cast<double>(std::max<std::size_t>(1, least_bytes(element, header.format)));
    if (static_cast<double>(element.count) * least <= static_cast<double>(body) + 1) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: header declares {} of '{}', more than the file can hold ({} bytes after the header)",
                            name, element.count, element.name, body));
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return static_cast<int>(i);
  }
  return -1;
}

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

}  // namespace sprung
