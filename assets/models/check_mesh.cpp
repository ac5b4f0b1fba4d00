#include "assets/models/check_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"

namespace sprung::models {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

void require(bool good, const std::string& name, const std::string& fault) {
  if (!good) throw Error(ErrorKind::kFailed, name + ": " + fault);
}

Surface surface_from(const Toy& toy, const std::string& name) {
  Surface surface;
  for (const auto& row : toy.positions.rowwise()) {
    surface.add_vertex(Kernel::Point_3(double{row[0]}, double{row[1]}, double{row[2]}));
  }
  for (const auto& row : toy.triangles.rowwise()) {
    const auto vertex = [&](int corner) { return Surface::Vertex_index(static_cast<Surface::size_type>(row[corner])); };
    const auto face = surface.add_face(vertex(0), vertex(1), vertex(2));
    require(face != Surface::null_face(), name, "an edge with more than two triangles, or two that disagree");
  }
  return surface;
}

bool is_manifold(const Surface& surface) {
  return std::none_of(surface.vertices().begin(), surface.vertices().end(),
                      [&](auto v) { return surface.is_isolated(v) || pmp::is_non_manifold_vertex(v, surface); });
}

double smallest_angle(const Toy& toy, Eigen::Index t) {
  double smallest = 180;
  for (int corner = 0; corner < 3; ++corner) {
    const auto point = [&](int c) -> Vec3 { return toy.positions.row(toy.triangles(t, c % 3)).cast<double>(); };
    const Vec3 a = (point(corner + 1) - point(corner)).normalized();
    const Vec3 b = (point(corner + 2) - point(corner)).normalized();
    smallest = std::min(smallest, std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / std::numbers::pi);
  }
  return smallest;
}

}  // namespace

Health check_mesh(const Toy& toy, const std::string& name) {
  const Surface surface = surface_from(toy, name);
  require(CGAL::is_closed(surface), name, "the surface is open");
  require(is_manifold(surface), name, "a vertex where two sheets touch");
  std::vector<std::size_t> pieces(surface.number_of_faces());
  const auto piece_map = boost::make_iterator_property_map(pieces.begin(), get(boost::face_index, surface));
  require(pmp::connected_components(surface, piece_map) == 1, name, "more than one piece");
  require(!pmp::does_self_intersect(surface), name, "the surface crosses itself");
  require(pmp::is_outward_oriented(surface), name, "the surface is inside out");
  const double bottom = double{toy.positions.col(1).minCoeff()};
  require(std::abs(bottom) < 1e-4, name, "it stands at y = " + std::to_string(bottom) + " m instead of 0");

  Health health;
  health.volume = pmp::volume(surface);
  health.smallest_angle = 180;
  for (Eigen::Index t = 0; t < toy.triangles.rows(); ++t) {
    const double angle = smallest_angle(toy, t);
    health.smallest_angle = std::min(health.smallest_angle, angle);
    if (angle < 20) ++health.thin_triangles;
  }
  return health;
}

}  // namespace sprung::models
