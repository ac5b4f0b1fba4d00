#include <fmt/format.h>

#include <filesystem>
#include <span>

#include "core/mesh/io/polygon_soup.h"
#include "core/mesh/io/readers.h"
#include "core/mesh/io/text_scanner.h"

namespace sprung {
namespace {

/// The vertex attributes that the first word of the file declares, in the order of their numbers.
struct VertexLayout {
  bool normals = false;
  bool colors = false;
  bool uvs = false;
};

VertexLayout read_layout(TextScanner& scanner) {
  const std::string_view word = scanner.next_line() ? scanner.word() : std::string_view{};
  if (!word.ends_with("OFF")) scanner.refuse("is not an OFF file (it does not begin with 'OFF')");
  std::string_view prefix = word.substr(0, word.size() - 3);
  VertexLayout layout;
  const auto takes = [&](std::string_view letters) {
    if (!prefix.starts_with(letters)) return false;
    prefix.remove_prefix(letters.size());
    return true;
  };
  layout.uvs = takes("ST");
  layout.colors = takes("C");
  layout.normals = takes("N");
  if (!prefix.empty()) {
    scanner.refuse(
        fmt::format("is a {} file, whose points have other than three coordinates; save it as OFF, PLY or OBJ", word));
  }
  return layout;
}

struct Counts {
  long vertices = 0;
  long faces = 0;
};

Counts read_counts(TextScanner& scanner) {
  std::string_view word = scanner.word_ahead();
  if (word == "BINARY") scanner.refuse("is a binary OFF file, which is not supported; save it as text, PLY or OBJ");
  const auto vertices = number_of(word);
  word = scanner.word_ahead();
  const auto faces = number_of(word);
  if (!vertices || !faces || !(*vertices >= 0) || !(*faces >= 0)) {
    scanner.refuse("the header holds no counts of vertices and faces");
  }
  static_cast<void>(scanner.rest());  // the number of edges, which is unreliable
  // A vertex takes at least 6 bytes, a face 4: one-digit numbers and separators.
  const auto size = double(scanner.after().size());
  const auto check = [&](double count, std::string_view things, double min_bytes) {
    if (count * min_bytes <= size + min_bytes) return;
    scanner.refuse(
        fmt::format("header declares {:.0f} {}, more than the file can hold ({:.0f} bytes)", count, things, size));
  };
  check(*vertices, "vertices", 6);
  check(*faces, "faces", 4);
  return {long(*vertices), long(*faces)};
}

/// The remaining numbers of a line, up to 16, and whether one of them has a decimal point.
struct Numbers {
  std::vector<double> values;
  bool fractions = false;
};

Numbers rest_of_line(TextScanner& scanner) {
  Numbers numbers;
  for (std::string_view word = scanner.word(); !word.empty() && numbers.values.size() < 16; word = scanner.word()) {
    const auto value = number_of(word);
    if (!value) break;
    numbers.values.push_back(*value);
    numbers.fractions = numbers.fractions || word.find('.') != std::string_view::npos;
  }
  static_cast<void>(scanner.rest());
  return numbers;
}

/// Colours are bytes or, if a number has a decimal point, in [0, 1]; white for fewer than three numbers.
Eigen::Vector4f color_of(std::span<const double> values, bool fractions) {
  Eigen::Vector4f color = Eigen::Vector4f::Ones();
  if (values.size() < 3) return color;
  for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 4); ++i) {
    color[i] = float(fractions ? values[i] : values[i] / 255);
  }
  return color.array().isFinite().all() ? Eigen::Vector4f(color.cwiseMax(0.0F).cwiseMin(1.0F))
                                        : Eigen::Vector4f::Ones();
}

/// The coordinates of a vertex are followed by its normal, colour and UV, as far as the layout has them.
void read_vertex(TextScanner& scanner, const VertexLayout& layout, const std::string& name, PolygonSoup& soup) {
  const Named what{"vertex", std::ssize(soup.positions) + 1};
  Vec3 position;
  for (double& coordinate : position) coordinate = scanner.number_ahead(what);
  add_position(soup, position, name);
  const Numbers numbers = rest_of_line(scanner);
  std::span<const double> left(numbers.values);
  const std::size_t needed = (layout.normals ? 3U : 0U) + (layout.uvs ? 2U : 0U);
  if (left.size() < needed) scanner.refuse(fmt::format("{} lacks its normal or its UV", what.text()));
  if (layout.normals) {
    add_normal(soup, {left[0], left[1], left[2]});
    left = left.subspan(3);
  }
  if (layout.uvs) {
    add_uv(soup, {left[left.size() - 2], left.back()});
    left = left.first(left.size() - 2);
  }
  if (layout.colors) soup.colors.push_back(color_of(left, numbers.fractions));
}

/// The corners are followed by the face's colour.
void read_face(TextScanner& scanner, const VertexLayout& layout, long face, PolygonSoup& soup) {
  const Named what{"face", face};
  const long corners = scanner.integer_ahead(what);
  const std::size_t first = soup.corners.size();
  for (long i = 0; i < corners; ++i) {
    const long vertex = scanner.integer_ahead(what);
    if (vertex < 0 || vertex >= std::ssize(soup.positions)) {
      scanner.refuse(fmt::format("{} refers to vertex {}, but they run from 0 to {} (index out of range)", what.text(),
                                 vertex, std::ssize(soup.positions) - 1));
    }
    const int row = int(vertex);
    soup.corners.push_back({row, layout.uvs ? row : -1, layout.normals ? row : -1});
  }
  static_cast<void>(scanner.rest());
  if (corners >= 3) {
    soup.corner_counts.push_back(int(corners));
    soup.polygon_parts.push_back(0);
  } else {
    soup.corners.resize(first);
  }
}

}  // namespace

SurfaceMesh read_off(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name);
  const VertexLayout layout = read_layout(scanner);
  const Counts counts = read_counts(scanner);
  PolygonSoup soup;
  soup.parts.push_back({.name = std::filesystem::path(name).stem().string()});
  for (long v = 0; v < counts.vertices; ++v) read_vertex(scanner, layout, name, soup);
  for (long f = 0; f < counts.faces; ++f) read_face(scanner, layout, f + 1, soup);
  return mesh_from(std::move(soup), name);
}

}  // namespace sprung
