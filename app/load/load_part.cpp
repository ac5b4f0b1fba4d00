#include "app/load/load_part.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <set>

#include "app/scene/scene_values.h"
#include "core/error.h"
#include "core/mesh/query/closest_triangle.h"
#include "core/simulation/selector.h"
#include "core/skin/skin.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr std::array<std::string_view, 6> kSides{"x-low", "x-high", "y-low", "y-high", "z-low", "z-high"};

constexpr double kFinest = 0.01;   // of the longest side: triangles in which regions are looked for
constexpr double kFarAway = 0.05;  // of it: a face further from a point is not meant

/// "1,2,3". Empty if it is no list of so many numbers.
std::vector<double> numbers_in(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  while (true) {
    const auto comma = text.find(',');
    try {
      numbers.push_back(parse_quantity(text.substr(0, comma), Dimension::kNone));
    } catch (const Error&) {
      return {};
    }
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
  }
  return numbers.size() == count ? numbers : std::vector<double>{};
}

/// The numbers behind "face=". Throws Error(kUsage).
std::vector<double> region_numbers(const std::string& text, std::string_view word, std::size_t count,
                                   std::string_view form) {
  std::vector<double> numbers = numbers_in(std::string_view(text).substr(word.size()), count);
  if (!numbers.empty()) return numbers;
  throw Error(ErrorKind::kUsage, fmt::format("'{}': write {}{}, numbers in the unit of the file", text, word, form));
}

/// A point of the file in fractions of the bounding box.
Vec3 fractions_of(const LoadPart& part, const double* file) {
  const Vec3 rest = part.rest_from_file(Vec3(file[0], file[1], file[2]));
  const Eigen::Array3d extent = part.loaded.extent.array().max(1e-9 * part.loaded.extent.maxCoeff());
  return rest.array() / extent + 0.5;
}

std::vector<std::string_view> names_in(const SurfaceMesh& mesh) {
  std::set<std::string_view> names;
  for (const Part& part : mesh.parts) {
    if (!part.name.empty()) names.insert(part.name);
    if (part.material >= 0 && !mesh.materials[part.material].name.empty()) {
      names.insert(mesh.materials[part.material].name);
    }
  }
  return {names.begin(), names.end()};
}

/// "from (0, 0, 0) to (80, 60, 30) mm".
std::string reach_text(const LoadPart& part) {
  const Vec3 low = part.file_from_rest(-part.loaded.extent / 2);
  const Vec3 high = part.file_from_rest(part.loaded.extent / 2);
  return fmt::format("from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) {}", low.x(), low.y(), low.z(),
                     high.x(), high.y(), high.z(), part.unit_name);
}

void check_nearness(const LoadPart& part, const std::string& text, const Vec3& point) {
  const NearestTriangle surface(part.loaded.mesh.positions, part.loaded.mesh.triangles);
  const SurfaceProjection nearest = surface.at(part.rest_from_file(point));
  if (nearest.distance <= kFarAway * part.loaded.extent.maxCoeff()) return;
  const Vec3 there = part.file_from_rest(nearest.point);
  throw Error(ErrorKind::kUsage,
              fmt::format("'{}' is {:.4g} {} away from {}, which reaches {}; the nearest point of its surface is "
                          "{:.4g},{:.4g},{:.4g}",
                          text, nearest.distance / part.unit, part.unit_name, part.loaded.name, reach_text(part),
                          there.x(), there.y(), there.z()));
}

Selection selection_from(const LoadPart& part, const std::string& text) {
  Selection selection;
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    if (text != kSides[side]) continue;
    const int axis = int(side) / 2;
    const bool is_high = side % 2 == 1;
    selection.box.emplace();
    (is_high ? selection.box->min : selection.box->max)[axis] = is_high ? 1 : 0;
    return selection;
  }
  if (text.starts_with("face=")) {
    const std::vector<double> numbers = region_numbers(text, "face=", 3, "X,Y,Z");
    check_nearness(part, text, Vec3(numbers[0], numbers[1], numbers[2]));
    selection.face = fractions_of(part, numbers.data());
  } else if (text.starts_with("box=")) {
    const std::vector<double> numbers = region_numbers(text, "box=", 6, "X,Y,Z,X,Y,Z (two corners)");
    const Vec3 a = fractions_of(part, numbers.data());
    const Vec3 b = fractions_of(part, numbers.data() + 3);
    selection.box = Box{a.cwiseMin(b), a.cwiseMax(b)};
  } else if (text.starts_with("ball=")) {
    const std::vector<double> numbers = region_numbers(text, "ball=", 4, "X,Y,Z,RADIUS");
    selection.sphere = Ball{.centre = fractions_of(part, numbers.data()),
                            .radius = numbers[3] * part.unit / part.loaded.extent.maxCoeff()};
  } else if (text.starts_with('#')) {
    try {
      Color color;
      parse_value(text, {.name = "colour", .help = ""}, color);
      selection.painted = color;
    } catch (const Error& error) {
      throw Error(ErrorKind::kUsage, error.what());
    }
  } else {
    selection.part = text;
  }
  return selection;
}

/// Adds the part of one solid's surface that a selection covers.
void add_pieces(const Skin& skin, const std::vector<SkinPiece>& pieces, PartFace& face) {
  for (const SkinPiece& piece : pieces) {
    Mat3 corners;
    for (int corner = 0; corner < 3; ++corner) {
      corners.col(corner) = skin.positions.row(skin.triangles(piece.triangle, corner)).transpose();
    }
    const Vec3 area = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)) / 2 * piece.share();
    face.area += area.norm();
    face.outward += area;
    face.centre += area.norm() * (corners * piece.corners.rowwise().mean());
  }
}

[[noreturn]] void refuse(const LoadPart& part, const std::string& text) {
  std::vector<std::string_view> known(kSides.begin(), kSides.end());
  const std::vector<std::string_view> names = names_in(part.loaded.mesh);
  known.insert(known.end(), names.begin(), names.end());
  const std::string parts =
      names.empty() ? std::string("the mesh has no named parts") : fmt::format("parts: {}", fmt::join(names, ", "));
  const std::string_view nearest = nearest_word(text, known);
  throw Error(ErrorKind::kUsage,
              fmt::format("{} has no face '{}'{}; sides: {}; {}; or face=X,Y,Z (the face nearest to a point), "
                          "box=X,Y,Z,X,Y,Z, ball=X,Y,Z,R, #rrggbb",
                          part.loaded.name, text,
                          nearest.empty() ? std::string() : fmt::format(", did you mean '{}'?", nearest),
                          fmt::join(kSides, " "), parts));
}

}  // namespace

Vec3 point_from(std::string_view option, const std::string& text) {
  const std::vector<double> numbers = numbers_in(text, 3);
  if (numbers.empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("{} '{}': write X,Y,Z, numbers in the unit of the file", option, text));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

PartFace find_face(const LoadPart& part, const std::string& text) {
  PartFace face{.name = text, .selection = selection_from(part, text)};
  const std::string& name = face.selection.part;
  const std::vector<std::string_view> names = names_in(part.loaded.mesh);
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) refuse(part, text);
  const Selector selector(part.loaded);
  for (std::size_t row = 0; row < part.loaded.solids.size(); ++row) {
    Skin skin;
    skin.positions = part.loaded.solids[row].points;
    skin.triangles = part.loaded.solids[row].triangles;
    skin.normals = Points::Zero(skin.positions.rows(), 3);
    skin.parts.push_back({.name = "", .triangle_count = int(skin.triangles.rows())});
    if (face.selection.sphere || face.selection.box) refine(skin, kFinest * part.loaded.extent.maxCoeff());
    add_pieces(skin, selector.skin_pieces(face.selection, skin.positions, skin.triangles, row), face);
  }
  if (!(face.area > 0)) {
    const bool is_side = std::find(kSides.begin(), kSides.end(), text) != kSides.end();
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}': {} {}; it reaches {}. Choose another by face=X,Y,Z (the face nearest to a point), "
                            "box=X,Y,Z,X,Y,Z or ball=X,Y,Z,R (the surface in there)",
                            text, part.loaded.name,
                            is_side ? "has no flat face there" : "has nothing of its surface there", reach_text(part)));
  }
  face.centre /= face.area;
  face.outward /= face.area;
  return face;
}

std::optional<Vec3> direction_from(const std::string& text, const PartFace& face) {
  if (text == "in" || text == "out") {
    if (face.outward.norm() < 0.1) {
      throw Error(ErrorKind::kUsage,
                  fmt::format("'{}' has no single outward direction: name one, +x ... -z or X,Y,Z", face.name));
    }
    return face.outward.normalized() * (text == "in" ? -1 : 1);
  }
  const bool has_sign = text.size() == 2 && (text[0] == '+' || text[0] == '-');
  const char axis = has_sign ? text[1] : (text.size() == 1 ? text[0] : ' ');
  if (axis >= 'x' && axis <= 'z') return Vec3(Vec3::Unit(axis - 'x') * (has_sign && text[0] == '-' ? -1 : 1));
  const std::vector<double> numbers = numbers_in(text, 3);
  if (numbers.empty()) return std::nullopt;
  const Vec3 direction(numbers[0], numbers[1], numbers[2]);
  if (!(direction.norm() > 0)) throw Error(ErrorKind::kUsage, fmt::format("'{}' is no direction", text));
  return direction.normalized();
}

}  // namespace sprung
