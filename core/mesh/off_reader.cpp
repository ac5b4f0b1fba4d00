#include "core/mesh/off_reader.h"

#include <CGAL/IO/OFF.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <fstream>

#include "core/error.h"
#include "core/mesh/polygon.h"

namespace sprung {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<int>> polygons;
  std::vector<CGAL::IO::Color> colors;
};

Soup read_soup(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Soup soup;
  bool done = false;
  try {
    const auto colors = CGAL::parameters::vertex_color_output_iterator(std::back_inserter(soup.colors));
    done = CGAL::IO::read_OFF(stream, soup.points, soup.polygons, colors);
  } catch (const std::exception&) {
    done = false;
  }
  if (!done) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: not a valid OFF file: a number is missing, or a face refers to a "
                            "vertex that is not there",
                            file.string()));
  }
  return soup;
}

}  // namespace

SurfaceMesh read_off(const std::filesystem::path& file) {
  const Soup soup = read_soup(file);
  SurfaceMesh mesh;
  mesh.positions.resize(static_cast<int>(soup.points.size()), 3);
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const Point& p = soup.points[static_cast<std::size_t>(v)];
    mesh.positions.row(v) = Vec3(p.x(), p.y(), p.z());
  }
  if (!soup.colors.empty() && soup.colors.size() == soup.points.size()) {
    mesh.colors.resize(mesh.positions.rows(), 4);
    for (int v = 0; v < mesh.colors.rows(); ++v) {
      const CGAL::IO::Color& c = soup.colors[static_cast<std::size_t>(v)];
      mesh.colors.row(v) = Eigen::Vector4f(c.red(), c.green(), c.blue(), 255.0F) / 255.0F;
    }
  }
  std::vector<std::array<int, 3>> triangles;
  for (const auto& polygon : soup.polygons) {
    if (polygon.size() >= 3) cut_polygon(mesh.positions, polygon, triangles);
  }
  mesh.triangles.resize(static_cast<int>(triangles.size()), 3);
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    const auto& corners = triangles[static_cast<std::size_t>(t)];
    mesh.triangles.row(t) = Eigen::Vector3i(corners[0], corners[1], corners[2]);
  }
  mesh.parts.push_back({.name = file.stem().string(), .triangle_count = static_cast<int>(triangles.size())});
  return mesh;
}

}  // namespace sprung
