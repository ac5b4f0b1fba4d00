#include "assets/models/mesh_model.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/facets_in_complex_3_to_triangle_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>

namespace sprung::models {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr double kGradientStep = 1e-4;  // cm

Vec3 vec_from(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Longest edge wanted at p: the borders of paint are as fine as they fade, and coarser away from them.
double edge_at(const Model& model, const Vec3& p) {
  constexpr double kGrowth = 0.6;
  double edge = model.edge;
  for (const Layer& layer : model.layers) {
    const double distance = std::max(std::abs(layer.region(p)) - layer.border, 0.0);
    edge = std::min(edge, layer.border + kGrowth * distance);
  }
  return edge;
}

/// Radius of the ball about a facet, as the mesher asks for it: that of an equilateral triangle.
struct FacetSize {
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = Domain::Index;
  const Model* model;
  FT operator()(const Point_3& p, int, const Index&) const { return edge_at(*model, vec_from(p)) / std::sqrt(3.0); }
};

Surface delaunay_surface(const Model& model) {
  namespace params = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(1);
  CGAL::Random random(1);
  const auto inside = [&](const Kernel::Point_3& p) { return model.shape(vec_from(p)); };
  const Kernel::Point_3 center(model.center.x(), model.center.y(), model.center.z());
  const Kernel::Sphere_3 around(center, model.radius * model.radius);
  Domain domain =
      Domain::create_implicit_mesh_domain(inside, around, params::relative_error_bound = 1e-5, params::p_rng = &random);
  const Criteria criteria(params::facet_angle = 28, params::facet_size = FacetSize{&model},
                          params::facet_distance = model.tolerance);
  const Complex complex =
      CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude(), params::manifold());
  Surface surface;
  CGAL::facets_in_complex_3_to_triangle_mesh(complex, surface);
  return surface;
}

/// The nearest point of the surface, for points close to it: Newton along the gradient.
Vec3 project(const Shape& shape, Vec3 p) {
  for (int i = 0; i < 6; ++i) {
    const double distance = shape(p);
    if (std::abs(distance) < 1e-8) break;
    const Vec3 slope = gradient(shape, p, kGradientStep);
    p -= distance * slope / std::max(slope.squaredNorm(), 1e-6);
  }
  return p;
}

/// Moves every vertex half way to the middle of its triangles, weighted so that the grading of sizes stays, and back
/// onto the surface.
void relax(const Model& model, Surface& surface, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec3> moved;
    for (const auto v : surface.vertices()) {
      const Vec3 here = vec_from(surface.point(v));
      Vec3 sum = Vec3::Zero();
      double weights = 0;
      for (const auto n : CGAL::vertices_around_target(v, surface)) {
        const Vec3 there = vec_from(surface.point(n));
        const double weight = 1 / edge_at(model, (here + there) / 2);
        sum += weight * there;
        weights += weight;
      }
      moved.push_back(project(model.shape, (here + sum / weights) / 2));
    }
    for (const auto v : surface.vertices()) {
      const Vec3& p = moved[v.idx()];
      surface.point(v) = Kernel::Point_3(p.x(), p.y(), p.z());
    }
  }
}

Color color_at(const Model& model, const Vec3& p) {
  Color color = model.base(p);
  for (const Layer& layer : model.layers) {
    const double inside = std::clamp(0.5 - layer.region(p) / layer.border, 0.0, 1.0);
    const double share = layer.opacity * inside * inside * (3 - 2 * inside);
    color = (1 - share) * color + share * layer.color;
  }
  return color;
}

}  // namespace

Toy mesh_model(const Model& model) {
  constexpr double kMetres = 0.01;
  Surface surface = delaunay_surface(model);
  relax(model, surface, 8);
  const auto count = Eigen::Index(surface.number_of_vertices());
  Toy toy;
  toy.positions.resize(count, 3);
  toy.normals.resize(count, 3);
  if (model.base) toy.colors.resize(count, 3);
  for (const auto v : surface.vertices()) {
    const auto row = Eigen::Index(v.idx());
    const Vec3 p = vec_from(surface.point(v));
    toy.positions.row(row) = (kMetres * p).cast<float>();
    toy.normals.row(row) = gradient(model.shape, p, kGradientStep).normalized().cast<float>();
    if (model.base) toy.colors.row(row) = (255 * color_at(model, p)).array().round().cast<unsigned char>();
  }
  toy.triangles.resize(surface.number_of_faces(), 3);
  for (const auto f : surface.faces()) {
    int corner = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface)) {
      toy.triangles(f.idx(), corner++) = int(v.idx());
    }
  }
  return toy;
}

}  // namespace sprung::models
