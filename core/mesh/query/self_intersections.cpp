#include "core/mesh/query/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <vector>

namespace sprung {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Pair = std::array<int, 2>;

/// The box of one triangle, with its row.
class TriangleBox : public CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_NONE> {
 public:
  TriangleBox(const CGAL::Bbox_3& bounds, int row) : Box_d(bounds), row_(row) {}
  [[nodiscard]] int row() const { return row_; }
  [[nodiscard]] std::size_t id() const { return row_; }

 private:
  int row_;
};

/// Tests pairs of triangles.
class PairTest {
 public:
  PairTest(const Points& points, const Triangles& triangles) : triangles_(triangles) {
    points_.reserve(points.rows());
    for (const auto& point : points.rowwise()) points_.emplace_back(point.x(), point.y(), point.z());
  }

  [[nodiscard]] bool has_area(int t) const { return !CGAL::collinear(corner(t, 0), corner(t, 1), corner(t, 2)); }

  [[nodiscard]] CGAL::Bbox_3 bounds(int t) const {
    return corner(t, 0).bbox() + corner(t, 1).bbox() + corner(t, 2).bbox();
  }

  /// Whether two triangles intersect outside their shared corners and edges.
  [[nodiscard]] bool cross(int a, int b) const {
    int shared = 0;
    Pair at_a{};
    Pair at_b{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (triangles_(a, i) != triangles_(b, j) || shared == 2) continue;
        at_a[shared] = i;
        at_b[shared] = j;
        ++shared;
      }
    }
    if (shared == 0) return CGAL::do_intersect(triangle(a), triangle(b));
    if (shared == 1) {
      return CGAL::do_intersect(triangle(a), opposite_side(b, at_b[0])) ||
             CGAL::do_intersect(triangle(b), opposite_side(a, at_a[0]));
    }
    return fold_onto_each_other(corner(a, at_a[0]), corner(a, at_a[1]), corner(a, 3 - at_a[0] - at_a[1]),
                                corner(b, 3 - at_b[0] - at_b[1]));
  }

 private:
  [[nodiscard]] const Point& corner(int t, int c) const { return points_[triangles_(t, c % 3)]; }
  [[nodiscard]] Kernel::Triangle_3 triangle(int t) const { return {corner(t, 0), corner(t, 1), corner(t, 2)}; }
  [[nodiscard]] Kernel::Segment_3 opposite_side(int t, int c) const { return {corner(t, c + 1), corner(t, c + 2)}; }

  /// Triangles on the edge p q with the tips a and b.
  static bool fold_onto_each_other(const Point& p, const Point& q, const Point& a, const Point& b) {
    return CGAL::coplanar(p, q, a, b) && CGAL::coplanar_orientation(p, q, a, b) == CGAL::POSITIVE;
  }

  const Triangles& triangles_;
  std::vector<Point> points_;
};

/// Pairs with overlapping boxes.
std::vector<Pair> near_pairs(const PairTest& test, int triangles) {
  std::vector<TriangleBox> boxes;
  for (int t = 0; t < triangles; ++t) {
    if (test.has_area(t)) boxes.emplace_back(test.bounds(t), t);
  }
  std::vector<Pair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const TriangleBox& a, const TriangleBox& b) {
    pairs.push_back({std::min(a.row(), b.row()), std::max(a.row(), b.row())});
  });
  return pairs;
}

}  // namespace

std::vector<std::array<int, 2>> find_self_intersections(const Points& points, const Triangles& triangles) {
  const PairTest test(points, triangles);
  const std::vector<Pair> pairs = near_pairs(test, int(triangles.rows()));
  const auto join = [](std::vector<Pair> all, const std::vector<Pair>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const auto look_at = [&](const tbb::blocked_range<std::size_t>& range, std::vector<Pair> found) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (test.cross(pairs[i][0], pairs[i][1])) found.push_back(pairs[i]);
    }
    return found;
  };
  std::vector<Pair> crossings =
      tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, pairs.size(), 4096), std::vector<Pair>{}, look_at, join);
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

}  // namespace sprung
