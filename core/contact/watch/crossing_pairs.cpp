#include "core/contact/watch/crossing_pairs.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Vec3, 3>;
using Node = DrawnSurface::Node;

Corners corners_of(const DrawnSurface& surface, int row) {
  const auto corner = [&](int i) { return Vec3(surface.points().row(surface.triangles()(row, i))); };
  return {corner(0), corner(1), corner(2)};
}

/// Whether the triangles lie on different sides along `axis`, by more than rounding errors.
bool are_apart(const Vec3& axis, const Corners& a, const Corners& b, double scale) {
  const double a0 = axis.dot(a[0]);
  const double a1 = axis.dot(a[1]);
  const double a2 = axis.dot(a[2]);
  const double b0 = axis.dot(b[0]);
  const double b1 = axis.dot(b[1]);
  const double b2 = axis.dot(b[2]);
  const double margin = 1e-14 * scale * axis.cwiseAbs().maxCoeff();
  return std::max({a0, a1, a2}) < std::min({b0, b1, b2}) - margin ||
         std::max({b0, b1, b2}) < std::min({a0, a1, a2}) - margin;
}

/// Whether the plane of `a`, or one at right angles to it through an edge, separates the two.
bool is_separated_by(const Corners& a, const Corners& b, double scale) {
  const std::array<Vec3, 3> edges{a[1] - a[0], a[2] - a[1], a[0] - a[2]};
  const Vec3 normal = edges[0].cross(edges[1]);
  if (are_apart(normal, a, b, scale)) return true;
  return std::any_of(edges.begin(), edges.end(),
                     [&](const Vec3& edge) { return are_apart(normal.cross(edge), a, b, scale); });
}

double scale_of(const Corners& corners) {
  double scale = 0;
  for (const Vec3& corner : corners) scale = std::max(scale, corner.cwiseAbs().maxCoeff());
  return scale;
}

Kernel::Point_3 point_of(const Vec3& position) { return {position.x(), position.y(), position.z()}; }

bool is_flat(const Corners& a) { return CGAL::collinear(point_of(a[0]), point_of(a[1]), point_of(a[2])); }

/// The longest side: all of a triangle without area.
Kernel::Segment_3 longest_side(const Corners& a) {
  int longest = 0;
  const auto length = [&](int i) { return (a[(i + 1) % 3] - a[i]).squaredNorm(); };
  for (int i = 1; i < 3; ++i) {
    if (length(i) > length(longest)) longest = i;
  }
  return {point_of(a[longest]), point_of(a[(longest + 1) % 3])};
}

Kernel::Triangle_3 triangle_of(const Corners& a) { return {point_of(a[0]), point_of(a[1]), point_of(a[2])}; }

/// Descends into two trees at once.
class CellSearch {
 public:
  CellSearch(const DrawnSurface& a, const DrawnSurface& b) : a_(a), b_(b), is_self_(&a == &b) {}

  RowPairs find() {
    if (a_.nodes().empty() || b_.nodes().empty()) return {};
    if (!is_self_) {
      descend(0, 0);
      return std::move(found_);
    }
    for (std::size_t node = 0; node < a_.nodes().size(); ++node) look_within(int(node));
    if (const CellBricks* bricks = a_.bricks()) {
      found_.insert(found_.end(), bricks->suspects().begin(), bricks->suspects().end());
    }
    return std::move(found_);
  }

 private:
  void look_within(int row) {
    const Node& node = a_.nodes()[row];
    if (node.cell < 0) return descend(row + 1, node.second_child);
    if (a_.bricks() == nullptr) found_.push_back({node.cell, node.cell});
  }

  void descend(int row_a, int row_b) {
    const Node& a = a_.nodes()[row_a];
    const Node& b = b_.nodes()[row_b];
    if (!a.box.intersects(b.box)) return;
    if (a.cell >= 0 && b.cell >= 0) {
      add(a.cell, b.cell);
    } else if (b.cell >= 0 || (a.cell < 0 && a.box.sizes().maxCoeff() >= b.box.sizes().maxCoeff())) {
      descend(row_a + 1, row_b);
      descend(a.second_child, row_b);
    } else {
      descend(row_a, row_b + 1);
      descend(row_a, b.second_child);
    }
  }

  /// Neighbours in a body are checked only if their bricks require it.
  void add(int a, int b) {
    if (is_self_ && a > b) std::swap(a, b);
    if (is_self_ && a_.bricks() != nullptr && a_.bricks()->are_neighbours(a, b)) return;
    found_.push_back({a, b});
  }

  const DrawnSurface& a_;
  const DrawnSurface& b_;
  bool is_self_;
  RowPairs found_;
};

/// Compares the triangles of two cells.
class CellComparison {
 public:
  CellComparison(const DrawnSurface& a, const DrawnSurface& b) : a_(a), b_(b), is_self_(&a == &b) {}

  void compare(int cell_a, int cell_b, RowPairs& found) {
    const AlignedBox common = tight_box(a_, cell_a).intersection(tight_box(b_, cell_b));
    if (common.isEmpty()) return;
    list(a_, cell_a, common, first_);
    list(b_, cell_b, common, second_);
    for (const Facet& one : first_) {
      for (const Facet& other : second_) {
        if (is_self_ && cell_a == cell_b && other.row <= one.row) continue;
        if (!one.box.intersects(other.box) || (is_self_ && share_a_vertex(one.row, other.row))) continue;
        if (do_intersect(one.corners, other.corners)) {
          found.push_back(is_self_ ? std::array{std::min(one.row, other.row), std::max(one.row, other.row)}
                                   : std::array{one.row, other.row});
        }
      }
    }
  }

 private:
  struct Facet {
    int row;
    Corners corners;
    AlignedBox box;
  };

  static AlignedBox tight_box(const DrawnSurface& surface, int cell) {
    AlignedBox box;
    for (int row = surface.cells()[cell].first; row < surface.cells()[cell].last; ++row) {
      for (const int point : surface.triangles().row(row)) box.extend(Vec3(surface.points().row(point)));
    }
    return box;
  }

  static void list(const DrawnSurface& surface, int cell, const AlignedBox& common, std::vector<Facet>& facets) {
    facets.clear();
    for (int row = surface.cells()[cell].first; row < surface.cells()[cell].last; ++row) {
      Facet facet{.row = row, .corners = corners_of(surface, row), .box = {}};
      for (const Vec3& corner : facet.corners) facet.box.extend(corner);
      if (facet.box.intersects(common)) facets.push_back(facet);
    }
  }

  [[nodiscard]] bool share_a_vertex(int i, int j) const {
    const Triangles& triangles = a_.triangles();
    for (int corner = 0; corner < 3; ++corner) {
      if ((triangles.row(i).array() == triangles(j, corner)).any()) return true;
    }
    return false;
  }

  const DrawnSurface& a_;
  const DrawnSurface& b_;
  bool is_self_;
  std::vector<Facet> first_;
  std::vector<Facet> second_;
};

}  // namespace

bool do_intersect(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  const double scale = std::max(scale_of(a), scale_of(b));
  if (is_separated_by(a, b, scale) || is_separated_by(b, a, scale)) return false;
  const bool is_flat_a = is_flat(a);
  const bool is_flat_b = is_flat(b);
  if ((is_flat_a && longest_side(a).is_degenerate()) || (is_flat_b && longest_side(b).is_degenerate())) return false;
  if (is_flat_a && is_flat_b) return CGAL::do_intersect(longest_side(a), longest_side(b));
  if (is_flat_a) return CGAL::do_intersect(longest_side(a), triangle_of(b));
  if (is_flat_b) return CGAL::do_intersect(triangle_of(a), longest_side(b));
  return CGAL::do_intersect(triangle_of(a), triangle_of(b));
}

RowPairs cells_that_may_cross(const DrawnSurface& a, const DrawnSurface& b) { return CellSearch(a, b).find(); }

RowPairs crossing_pairs(const DrawnSurface& a, const DrawnSurface& b, const RowPairs& cells) {
  CellComparison comparison(a, b);
  RowPairs found;
  for (const auto& [cell_a, cell_b] : cells) comparison.compare(cell_a, cell_b, found);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace sprung
