#include "core/mesh/repair/coarsen.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <array>
#include <vector>

namespace sprung {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMS = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// False if the triangles are not a surface that Mesh can represent.
bool make_mesh(const Points& points, const Triangles& triangles, Mesh& mesh) {
  std::vector<std::array<std::size_t, 3>> corners(triangles.rows());
  for (int row = 0; row < triangles.rows(); ++row) {
    for (int i = 0; i < 3; ++i) {
      corners[row][i] = std::size_t(triangles(row, i));
    }
  }
  if (!PMP::is_polygon_soup_a_polygon_mesh(corners)) return false;
  std::vector<Point> places;
  places.reserve(points.rows());
  for (const auto& row : points.rowwise()) places.emplace_back(row.x(), row.y(), row.z());
  PMP::polygon_soup_to_polygon_mesh(places, corners, mesh);
  return true;
}

/// Of a mesh with contiguous indices.
CoarseSurface surface_of(const Mesh& mesh) {
  CoarseSurface surface{.points = Points(mesh.number_of_vertices(), 3),
                        .triangles = Triangles(mesh.number_of_faces(), 3)};
  for (const auto vertex : mesh.vertices()) {
    const Point& position = mesh.point(vertex);
    surface.points.row(vertex.idx()) << position.x(), position.y(), position.z();
  }
  for (const auto face : mesh.faces()) {
    int corner = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face))) {
      surface.triangles(face.idx(), corner++) = int(vertex.idx());
    }
  }
  return surface;
}

}  // namespace

CoarseSurface coarsen(const Points& points, const Triangles& triangles, double shortest) {
  Mesh mesh;
  if (!make_mesh(points, triangles, mesh)) return {points, triangles};
  SMS::edge_collapse(mesh, SMS::Edge_length_stop_predicate<double>(shortest),
                     CGAL::parameters::get_cost(SMS::Edge_length_cost<Mesh>())
                         .get_placement(SMS::LindstromTurk_placement<Mesh>())
                         .filter(SMS::Bounded_normal_change_filter<>()));
  mesh.collect_garbage();
  return surface_of(mesh);
}

}  // namespace sprung
