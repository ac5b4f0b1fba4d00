#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "core/error.h"
#include "core/mesh/io/polygon_soup.h"
#include "core/mesh/io/readers.h"
#include "core/mesh/io/text_scanner.h"

namespace sprung {
namespace {

constexpr std::size_t kHeader = 84;  // bytes of a binary file before its facets, including their number
constexpr std::size_t kFacet = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t at, int size) {
  std::uint32_t word = 0;
  for (int i = size; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

double float_at(std::string_view bytes, std::size_t at) {
  const std::uint32_t word = word_at(bytes, at, 4);
  float value = 0;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

std::size_t binary_size(std::string_view bytes) {
  return bytes.size() < kHeader ? kHeader : kHeader + kFacet * std::size_t{word_at(bytes, 80, 4)};
}

bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

/// Text files begin with "solid", but so do many binary ones: these have the declared size, or bytes that no text has.
bool is_text(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || !is_keyword(bytes.substr(first, 5), "solid")) return false;
  if (bytes.size() >= kHeader && bytes.size() == binary_size(bytes)) return false;
  return bytes.substr(0, 1000).find('\0') == std::string_view::npos;
}

/// 5 bits per channel: red lowest in files of Magics, which name a colour in the header, else blue lowest.
Eigen::Vector4f facet_color(std::uint32_t word, bool is_magics) {
  const auto channel = [&](int shift) { return float(word >> shift & 31U) / 31.0F; };
  return is_magics ? Eigen::Vector4f(channel(0), channel(5), channel(10), 1)
                   : Eigen::Vector4f(channel(10), channel(5), channel(0), 1);
}

void close_polygon(PolygonSoup& soup, int corners) {
  for (int i = 0; i < corners; ++i) soup.corners.push_back({isize(soup.positions) - corners + i});
  soup.corner_counts.push_back(corners);
  soup.polygon_parts.push_back(isize(soup.parts) - 1);
}

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < binary_size(bytes)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: file is shorter ({}) than its header says ({}); fetch or export "
                                                  "it again",
                                                  name, bytes.size(), binary_size(bytes)));
  }
  PolygonSoup soup;
  soup.single_precision = true;
  soup.parts.push_back({.name = std::filesystem::path(name).stem().string()});
  const bool is_magics = bytes.substr(0, 80).find("COLOR=") != std::string_view::npos;
  bool has_colors = false;
  for (std::size_t at = kHeader; at < binary_size(bytes); at += kFacet) {
    for (std::size_t corner = at + 12; corner < at + 48; corner += 12) {
      add_position(soup, {float_at(bytes, corner), float_at(bytes, corner + 4), float_at(bytes, corner + 8)}, name);
    }
    const std::uint32_t word = word_at(bytes, at + 48, 2);
    // The highest bit marks the facet's own colour; in files of Magics, its absence.
    const bool is_own = (word >> 15 != 0) != is_magics;
    has_colors = has_colors || is_own;
    soup.colors.insert(soup.colors.end(), 3, is_own ? facet_color(word, is_magics) : Eigen::Vector4f::Ones().eval());
    close_polygon(soup, 3);
  }
  if (!has_colors) soup.colors.clear();
  if (bytes.size() > binary_size(bytes)) {
    soup.notes.push_back(fmt::format("left out {} bytes after the {} facets that its header declares",
                                     bytes.size() - binary_size(bytes), word_at(bytes, 80, 4)));
  }
  return soup;
}

/// The facets of a text, word by word.
class TextReader {
 public:
  TextReader(std::string_view text, const std::string& name) : scanner_(text, name), name_(name) {}

  PolygonSoup read() {
    for (std::string_view word = scanner_.word_ahead(); !word.empty(); word = scanner_.word_ahead()) take(word);
    if (corners_ >= 0) scanner_.refuse(fmt::format("the file ends inside facet {}: it is cut short", facet_));
    if (in_solid_) soup_.notes.emplace_back("the file ends without 'endsolid'; it may be cut short");
    return std::move(soup_);
  }

 private:
  void take(std::string_view word) {
    if (is_keyword(word, "vertex")) {
      take_vertex();
    } else if (is_keyword(word, "facet")) {
      begin_facet();
    } else if (is_keyword(word, "end")) {  // some write it apart
      const std::string_view what = scanner_.word();
      const bool is_known = is_keyword(what, "facet") || is_keyword(what, "solid") || is_keyword(what, "loop");
      if (!is_known) scanner_.refuse(fmt::format("facet {} is followed by an 'end' without a keyword", facet_));
      take("end" + std::string(what));
    } else if (is_keyword(word, "endfacet")) {
      end_facet();
    } else if (is_keyword(word, "solid")) {
      in_solid_ = true;
      soup_.parts.push_back({.name = std::string(scanner_.rest())});
    } else if (is_keyword(word, "endsolid")) {
      in_solid_ = false;
      static_cast<void>(scanner_.rest());
    } else if (is_keyword(word, "color")) {  // of no standard; nothing says whether bytes or shares
      static_cast<void>(scanner_.rest());
    } else if (!is_keyword(word, "outer") && !is_keyword(word, "loop") && !is_keyword(word, "endloop")) {
      scanner_.refuse(fmt::format("facet {} is followed by a word that STL does not have", facet_));
    }
  }

  /// Normals follow from the vertices; what stands for one may be no numbers at all.
  void begin_facet() {
    if (is_keyword(scanner_.word(), "normal")) {
      for (int axis = 0; axis < 3; ++axis) static_cast<void>(scanner_.word());
    }
    ++facet_;
    corners_ = 0;
  }

  void take_vertex() {
    if (corners_ < 0) scanner_.refuse("a vertex stands outside of a facet");
    const Named what{"facet", facet_};
    Vec3 position;
    for (double& coordinate : position) coordinate = scanner_.number_ahead(what);
    add_position(soup_, position, name_);
    ++corners_;
  }

  void end_facet() {
    if (corners_ < 3) scanner_.refuse(fmt::format("facet {} has less than 3 vertices", facet_));
    if (soup_.parts.empty()) soup_.parts.emplace_back();
    close_polygon(soup_, corners_);
    corners_ = -1;
  }

  TextScanner scanner_;
  const std::string& name_;
  PolygonSoup soup_;
  long facet_ = 0;
  int corners_ = -1;  // of the current facet; -1: none
  bool in_solid_ = false;
};

}  // namespace

SurfaceMesh read_stl(std::string_view bytes, const std::string& name) {
  if (is_text(bytes)) return mesh_from(TextReader(bytes, name).read(), name);
  // Even truncated binary files contain zero bytes: in their attributes.
  if (bytes.size() < std::max(kHeader, binary_size(bytes)) && bytes.find('\0') == std::string_view::npos) {
    throw Error(ErrorKind::kBadInput, name + ": is not an STL file (it neither begins with 'solid' nor is it binary)");
  }
  return mesh_from(read_binary(bytes, name), name);
}

}  // namespace sprung
