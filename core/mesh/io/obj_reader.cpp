#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/mesh/io/polygon_soup.h"
#include "core/mesh/io/readers.h"
#include "core/mesh/io/text_scanner.h"
#include "core/text.h"

namespace sprung {
namespace {

/// The number of words of a texture map option that precede the file name: "-s 1 1 1", "-clamp on".
bool is_option_value(std::string_view word) { return number_of(word).has_value() || word == "on" || word == "off"; }

/// The file of a map_Kd line after its options; it may contain blanks.
std::string texture_name(TextScanner& scanner) {
  std::string_view word = scanner.word();
  while (word.starts_with('-')) {
    const bool takes_a_word = word == "-imfchan" || word == "-type";
    word = scanner.word();
    if (takes_a_word) {
      word = scanner.word();
      continue;
    }
    while (is_option_value(word)) word = scanner.word();
  }
  const std::string_view rest = scanner.rest();
  return rest.empty() ? std::string(word) : std::string(word.data(), rest.data() + rest.size());
}

void read_color(TextScanner& scanner, Eigen::Vector4f& color) {
  for (int channel = 0; channel < 3; ++channel) {
    const auto value = number_of(scanner.word());
    if (!value || !(*value >= 0)) return;
    color[channel] = float(std::min(*value, 1.0));
  }
}

}  // namespace

std::vector<SurfaceMaterial> read_mtl(std::string_view text) {
  std::vector<SurfaceMaterial> materials;
  TextScanner scanner(without_byte_order_mark(text), "MTL");
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword == "newmtl") materials.emplace_back().name = scanner.rest();
    if (materials.empty()) continue;
    if (keyword == "Kd") read_color(scanner, materials.back().color);
    if (keyword == "map_Kd") materials.back().texture_name = texture_name(scanner);
  }
  return materials;
}

namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name, const FindText& find_text)
      : scanner_(text, name), name_(name), find_text_(find_text), group_(std::filesystem::path(name).stem().string()) {}

  SurfaceMesh read() {
    while (scanner_.next_line()) take_line();
    check_rows();
    if (!fault_.empty()) throw Error(ErrorKind::kBadInput, fault_);
    if (soup_.corner_counts.empty() && free_form_ > 0) {
      throw Error(ErrorKind::kBadInput, name_ +
                                            ": holds free-form curves or surfaces only, which are not supported; "
                                            "export it as triangles");
    }
    if (free_form_ > 0) soup_.notes.emplace_back("left out free-form curves or surfaces");
    if (loose_ > 0)
      soup_.notes.push_back(
          fmt::format("left out {}", count_of(loose_, "loose point or line", "loose points and lines")));
    return mesh_from(std::move(soup_), name_);
  }

 private:
  void take_line() {
    const std::string_view keyword = scanner_.word();
    if (keyword == "v") {
      take_position();
    } else if (keyword == "vt") {
      const double u = scanner_.number({"UV", std::ssize(soup_.uvs) + 1});
      add_uv(soup_, {u, number_of(scanner_.word()).value_or(0)});
    } else if (keyword == "vn") {
      take_normal();
    } else if (keyword == "f" || keyword == "fo") {
      take_face();
    } else if (keyword == "o" || keyword == "g") {
      group_ = scanner_.rest();
      part_ = -1;
    } else if (keyword == "usemtl") {
      material_ = scanner_.rest();
      part_ = -1;
    } else if (keyword == "mtllib") {
      take_library(std::string(scanner_.rest()));
    } else if (keyword == "l") {
      ++loose_;
      ++soup_.lines;
    } else if (keyword == "p") {
      ++loose_;
    } else if (keyword == "curv" || keyword == "surf") {
      ++free_form_;
    }
  }

  /// x y z, or x y z w, or x y z red green blue.
  void take_position() {
    const Named what{"vertex", std::ssize(soup_.positions) + 1};
    Vec3 position;
    for (double& coordinate : position) coordinate = scanner_.number(what);
    std::array<double, 3> more{};
    std::size_t given = 0;
    while (given < more.size()) {
      const auto value = number_of(scanner_.word());
      if (!value) break;
      more[given++] = *value;
    }
    if (given == 1 && more[0] != 0) position /= more[0];
    if (given == 3 && soup_.colors.empty()) soup_.colors.assign(soup_.positions.size(), Eigen::Vector4f::Ones());
    if (given == 3) {
      Eigen::Vector4d color(more[0], more[1], more[2], 1);
      if (!color.allFinite()) color.setOnes();
      soup_.colors.emplace_back(color.cwiseMax(0).cwiseMin(1).cast<float>());
    } else if (!soup_.colors.empty()) {
      soup_.colors.emplace_back(Eigen::Vector4f::Ones());
    }
    if (!position.allFinite()) scanner_.refuse(what.text() + " has a coordinate that is not finite");
    soup_.positions.push_back(position);
  }

  void take_normal() {
    Vec3 normal;
    for (double& coordinate : normal) coordinate = scanner_.number({"normal", std::ssize(soup_.normals) + 1});
    add_normal(soup_, normal);
  }

  /// Rows count from 1, or backwards from the last one so far. check_rows checks them at the end, so that the first
  /// invalid face is the one reported.
  void take_face() {
    if (!fault_.empty()) return;
    const long first = soup_.corners.size();
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      soup_.corners.push_back(take_corner(word));
    }
    const long count = std::ssize(soup_.corners) - first;
    ++faces_;
    if (count < 3 || !fault_.empty()) {
      soup_.corners.resize(first);
      ++loose_;
      return;
    }
    soup_.corner_counts.push_back(int(count));
    soup_.polygon_parts.push_back(part());
    locations_.push_back({faces_, scanner_.line()});
  }

  Corner take_corner(std::string_view word) {
    const std::string_view whole = word;
    Corner corner{.position = take_row(word, std::ssize(soup_.positions), "vertex")};
    if (word.starts_with('/')) {
      word.remove_prefix(1);
      if (!word.empty() && word[0] != '/') corner.uv = take_row(word, std::ssize(soup_.uvs), "UV");
    }
    if (word.starts_with('/')) {
      word.remove_prefix(1);
      if (!word.empty()) corner.normal = take_row(word, std::ssize(soup_.normals), "normal");
    }
    if (!word.empty()) refuse_corner(whole);
    return corner;
  }

  [[noreturn]] void refuse_corner(std::string_view word) const {
    scanner_.refuse(fmt::format("face {} has a corner of {} characters that is not like 1, 1/2, 1//3 or 1/2/3",
                                faces_ + 1, word.size()));
  }

  /// Parses a number at the front of a word as a row from 0.
  int take_row(std::string_view& word, long so_far, std::string_view thing) {
    int index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error == std::errc::invalid_argument) refuse_corner(word);
    const long row = index < 0 ? so_far + index : index - 1L;
    const std::size_t length = end - word.data();
    if ((error != std::errc{} || row < 0) && fault_.empty()) {
      fault_ = fmt::format("{}:{}: face {} refers to {} {} of {} (index out of range)", name_, scanner_.line(),
                           faces_ + 1, thing, word.substr(0, length), so_far);
    }
    word.remove_prefix(length);
    return int(std::max(row, 0L));
  }

  /// The part of this group and material, created if there is none yet.
  int part() {
    if (part_ >= 0) return part_;
    const auto [found, is_new] = parts_.try_emplace({group_, material_}, isize(soup_.parts));
    if (is_new) soup_.parts.push_back({.name = group_, .material = material()});
    return part_ = found->second;
  }

  int material() {
    if (material_.empty()) return -1;
    for (std::size_t i = soup_.materials.size(); i-- > 0;) {
      if (soup_.materials[i].name == material_) return int(i);
    }
    return -1;
  }

  void take_library(const std::string& name) {
    if (const auto text = find_text_(name)) {
      for (SurfaceMaterial& material : read_mtl(*text)) soup_.materials.push_back(std::move(material));
    } else {
      soup_.notes.push_back(fmt::format("material file '{}' does not exist; drawn without it", name));
    }
  }

  void check_rows() const {
    auto corner = soup_.corners.begin();
    for (std::size_t f = 0; f < locations_.size(); ++f) {
      for (int i = 0; i < soup_.corner_counts[f]; ++i, ++corner) {
        check_row(f, corner->position, std::ssize(soup_.positions), "vertex");
        check_row(f, corner->uv, std::ssize(soup_.uvs), "UV");
        check_row(f, corner->normal, std::ssize(soup_.normals), "normal");
      }
    }
  }

  void check_row(std::size_t f, int row, long rows, std::string_view thing) const {
    if (row < rows) return;
    throw Error(ErrorKind::kBadInput, fmt::format("{}:{}: face {} refers to {} {} of {} (index out of range)", name_,
                                                  locations_[f].line, locations_[f].face, thing, row + 1L, rows));
  }

  struct Location {
    long face;
    long line;
  };

  TextScanner scanner_;
  const std::string& name_;
  const FindText& find_text_;
  PolygonSoup soup_;
  std::vector<Location> locations_;  // of the polygons
  std::map<std::pair<std::string, std::string>, int> parts_;
  std::string group_;
  std::string material_;
  std::string fault_;  // of the first face with an impossible row
  int part_ = -1;      // of the current group and material; -1: to be found
  long faces_ = 0;
  long loose_ = 0;
  long free_form_ = 0;
};

}  // namespace

SurfaceMesh read_obj(std::string_view text, const std::string& name, const FindText& find_text) {
  return ObjReader(text, name, find_text).read();
}

}  // namespace sprung
