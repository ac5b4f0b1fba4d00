#include "core/mesh/query/closest_triangle.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

namespace sprung {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

/// A triangle with its row.
struct Facet {
  int row;
  Kernel::Triangle_3 triangle;
};

/// The same as CGAL's trees take it.
class Primitive {
 public:
  using Id = int;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Triangle_3;

  explicit Primitive(std::vector<Facet>::const_iterator facet) : facet_(&*facet) {}
  [[nodiscard]] Id id() const { return facet_->row; }
  [[nodiscard]] const Datum& datum() const { return facet_->triangle; }
  [[nodiscard]] const Point& reference_point() const { return facet_->triangle[0]; }

 private:
  const Facet* facet_;
};

Kernel::Point_3 point_of(const Vec3& position) { return {position.x(), position.y(), position.z()}; }

}  // namespace

class NearestTriangle::Tree {
 public:
  Tree(const Points& points, const Triangles& triangles) {
    for (int row = 0; row < triangles.rows(); ++row) {
      const Vec3 a = points.row(triangles(row, 0));
      const Vec3 b = points.row(triangles(row, 1));
      const Vec3 c = points.row(triangles(row, 2));
      if (!((b - a).cross(c - a).squaredNorm() > 0)) continue;
      facets_.push_back({row, {point_of(a), point_of(b), point_of(c)}});
    }
    tree_.insert(facets_.cbegin(), facets_.cend());
    tree_.build();
    // Before concurrent queries.
    tree_.accelerate_distance_queries();
  }

  [[nodiscard]] SurfaceProjection at(const Vec3& position) const {
    const auto [point, row] = tree_.closest_point_and_primitive(point_of(position));
    const Vec3 nearest(point.x(), point.y(), point.z());
    return {.triangle = row, .point = nearest, .distance = (position - nearest).norm()};
  }

 private:
  std::vector<Facet> facets_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

NearestTriangle::NearestTriangle(const Points& points, const Triangles& triangles)
    : tree_(std::make_unique<Tree>(points, triangles)) {}
NearestTriangle::~NearestTriangle() = default;
NearestTriangle::NearestTriangle(NearestTriangle&&) noexcept = default;
NearestTriangle& NearestTriangle::operator=(NearestTriangle&&) noexcept = default;

SurfaceProjection NearestTriangle::at(const Vec3& position) const { return tree_->at(position); }

}  // namespace sprung
