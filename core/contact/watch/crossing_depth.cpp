#include "core/contact/watch/crossing_depth.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr double kInsideOut = -0.1;  // turns; the surface's own points have at least 0 where it is not folded over

using Edge = std::pair<int, int>;  // vertices, the lower one first

/// A point where an edge passes through a triangle.
struct Passage {
  double share;  // of the edge, from its first vertex
  int triangle;  // of the other surface
};

struct Facet {
  Vec3 a;
  Vec3 b;
  Vec3 c;
  [[nodiscard]] Vec3 normal() const { return (b - a).cross(c - a); }
};

Facet facet_of(const DrawnSurface& surface, int row) {
  const auto corner = [&](int i) { return Vec3(surface.points().row(surface.triangles()(row, i))); };
  return {corner(0), corner(1), corner(2)};
}

double distance_to(const Facet& facet, const Vec3& position) {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto point = [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  const Kernel::Triangle_3 triangle(point(facet.a), point(facet.b), point(facet.c));
  return std::sqrt(CGAL::squared_distance(point(position), triangle));
}

/// From the first vertex of the edge: its share up to the facet.
std::optional<double> way_to(const Facet& facet, const Vec3& from, const Vec3& to) {
  const Vec3 normal = facet.normal();
  const double before = normal.dot(from - facet.a);
  const double after = normal.dot(to - facet.a);
  if ((before > 0) == (after > 0)) return std::nullopt;
  const double share = before / (before - after);
  const Vec3 position = from + share * (to - from) - facet.a;
  const double beside_c = (facet.b - facet.a).cross(position).dot(normal);
  const double beside_b = position.cross(facet.c - facet.a).dot(normal);
  constexpr double kRounding = 1e-9;
  const double slack = kRounding * normal.squaredNorm();
  if (beside_b < -slack || beside_c < -slack || beside_b + beside_c > normal.squaredNorm() + slack) return std::nullopt;
  return share;
}

/// The part of one surface inside another that is connected to the crossing triangles.
class InnerPart {
 public:
  /// `side`: that of `surface` in the pairs.
  InnerPart(const DrawnSurface& surface, const DrawnSurface& other, const RowPairs& pairs, std::size_t side,
            const std::vector<int>& tangles)
      : surface_(surface), other_(other), is_known_(surface.points().rows()) {
    std::transform(tangles.begin(), tangles.end(), is_known_.begin(), [](int tangle) { return tangle != 0 ? 1 : 0; });
    for (const auto& pair : pairs) {
      add_passages(pair[side], pair[1 - side]);
      if (is_self()) add_passages(pair[1 - side], pair[side]);
    }
    for (auto& [edge, through] : passages_) {
      std::sort(through.begin(), through.end(), [](const Passage& a, const Passage& b) {
        return std::pair(a.share, a.triangle) < std::pair(b.share, b.triangle);
      });
    }
    std::vector<int> next;
    for (const auto& [edge, through] : passages_) {
      for (const int vertex : {edge.first, edge.second}) add_unknown(vertex, next);
    }
    while (!next.empty()) next = neighbours_of(add_inside(next));
  }

  [[nodiscard]] const std::vector<int>& vertices() const { return vertices_; }
  [[nodiscard]] const std::map<Edge, std::vector<Passage>>& passages() const { return passages_; }
  [[nodiscard]] bool is_inside(const Vec3& position) const {
    // A point on the surface itself gets half a turn from it.
    if (!other_.box().contains(position)) return false;
    const double turns = other_.winding().at(position);
    return is_self() ? turns > 1 || turns < kInsideOut : turns > 0.5;
  }

 private:
  [[nodiscard]] bool is_self() const { return &surface_ == &other_; }

  void add_unknown(int vertex, std::vector<int>& vertices) {
    if (is_known_[vertex] != 0) return;
    is_known_[vertex] = 1;
    vertices.push_back(vertex);
  }

  /// Returns those of the vertices that are inside.
  std::vector<int> add_inside(const std::vector<int>& vertices) {
    std::vector<char> are_inside(vertices.size());
    tbb::parallel_for(std::size_t{0}, vertices.size(),
                      [&](std::size_t i) { are_inside[i] = is_inside(surface_.points().row(vertices[i])) ? 1 : 0; });
    std::vector<int> found;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (are_inside[i] != 0) found.push_back(vertices[i]);
    }
    vertices_.insert(vertices_.end(), found.begin(), found.end());
    return found;
  }

  /// Those not classified yet.
  std::vector<int> neighbours_of(const std::vector<int>& vertices) {
    std::vector<int> found;
    for (const int vertex : vertices) {
      for (const int neighbour : surface_.neighbours()[vertex]) add_unknown(neighbour, found);
    }
    return found;
  }

  void add_passages(int own, int others) {
    for (int corner = 0; corner < 3; ++corner) {
      const Edge edge = std::minmax(surface_.triangles()(own, corner), surface_.triangles()(own, (corner + 1) % 3));
      const auto share =
          way_to(facet_of(other_, others), surface_.points().row(edge.first), surface_.points().row(edge.second));
      if (!share) continue;
      std::vector<Passage>& through = passages_[edge];
      const bool is_known = std::any_of(through.begin(), through.end(),
                                        [&](const Passage& passage) { return passage.triangle == others; });
      if (!is_known) through.push_back({.share = *share, .triangle = others});
    }
  }

  const DrawnSurface& surface_;
  const DrawnSurface& other_;
  std::vector<char> is_known_;  // by vertex
  std::vector<int> vertices_;
  std::map<Edge, std::vector<Passage>> passages_;
};

/// By vertex, unit or zero.
Points normals_of(const DrawnSurface& surface) {
  Points normals = Points::Zero(surface.points().rows(), 3);
  for (int row = 0; row < surface.triangles().rows(); ++row) {
    const Vec3 normal = facet_of(surface, row).normal();
    for (const int vertex : surface.triangles().row(row)) normals.row(vertex) += normal.transpose();
  }
  return normals.rowwise().normalized();
}

/// The distance of a point from a surface.
class Distance {
 public:
  explicit Distance(const DrawnSurface& surface) : surface_(surface) {}

  /// Only from triangles that face a surface of this normal; zero: from all.
  [[nodiscard]] double from(const Vec3& position, const Vec3& normal) const {
    double nearest = std::numeric_limits<double>::infinity();
    descend(0, position, normal, nearest);
    return nearest;
  }

 private:
  void descend(int row, const Vec3& position, const Vec3& normal, double& nearest) const {
    const DrawnSurface::Node& node = surface_.nodes()[row];
    if (node.cell < 0) {
      std::array<int, 2> children{row + 1, node.second_child};
      const auto way = [&](int child) { return surface_.nodes()[child].box.exteriorDistance(position); };
      if (way(children[1]) < way(children[0])) std::swap(children[0], children[1]);
      for (const int child : children) {
        if (way(child) < nearest) descend(child, position, normal, nearest);
      }
      return;
    }
    const DrawnSurface::Cell& cell = surface_.cells()[node.cell];
    for (int triangle = cell.first; triangle < cell.last; ++triangle) {
      const Facet facet = facet_of(surface_, triangle);
      const double reach = std::max((facet.b - facet.a).norm(), (facet.c - facet.a).norm());
      if ((facet.a - position).norm() - reach >= nearest) continue;
      if (!normal.isZero(0) && !(facet.normal().dot(normal) < 0)) continue;
      nearest = std::min(nearest, distance_to(facet, position));
    }
  }

  const DrawnSurface& surface_;
};

/// The deepest point of `surface` in the other.
void measure(const DrawnSurface& surface, const DrawnSurface& other, const RowPairs& pairs, std::size_t side,
             const std::vector<int>& tangles, CrossingDepth& deepest) {
  const InnerPart inner(surface, other, pairs, side, tangles);
  const bool is_self = &surface == &other;
  const Points normals = is_self ? normals_of(surface) : Points();
  const Distance distance(other);
  const auto keep_deeper = [&](const Vec3& position, const Vec3& normal) {
    const double depth = distance.from(position, normal);
    if (std::isfinite(depth) && depth > deepest.depth) deepest = {.depth = depth, .position = position};
  };
  const auto normal_at = [&](int vertex) { return is_self ? Vec3(normals.row(vertex)) : Vec3(Vec3::Zero()); };
  for (const int vertex : inner.vertices()) keep_deeper(surface.points().row(vertex), normal_at(vertex));
  for (const auto& [edge, through] : inner.passages()) {
    const Vec3 from = surface.points().row(edge.first);
    const Vec3 to = surface.points().row(edge.second);
    for (std::size_t i = 0; i + 1 < through.size(); ++i) {
      const Vec3 position = from + (through[i].share + through[i + 1].share) / 2 * (to - from);
      if (inner.is_inside(position)) keep_deeper(position, normal_at(edge.first) + normal_at(edge.second));
    }
  }
}

}  // namespace

CrossingDepth crossing_depth(const DrawnSurface& a, const DrawnSurface& b, const RowPairs& pairs,
                             const std::vector<int>& tangles) {
  CrossingDepth deepest;
  measure(a, b, pairs, 0, tangles, deepest);
  if (&a != &b) measure(b, a, pairs, 1, {}, deepest);
  return deepest;
}

std::vector<int> tangles_of(const DrawnSurface& surface, const RowPairs& pairs) {
  constexpr double kTouching = 0.9;  // turns: half from its own surface, half from what it touches, less the error
  const Triangles& triangles = surface.triangles();
  std::vector<char> are_tangled(surface.points().rows());
  tbb::parallel_for(std::size_t{0}, are_tangled.size(), [&](std::size_t vertex) {
    are_tangled[vertex] = surface.winding().at(surface.points().row(Eigen::Index(vertex))) > kTouching ? 1 : 0;
  });
  DisjointSets sets(are_tangled.size());
  for (const auto& [a, b] : pairs) {
    for (const int row : {a, b}) {
      for (const int vertex : triangles.row(row)) are_tangled[vertex] = 1;
    }
    sets.merge(triangles(a, 0), triangles(b, 0));
  }
  for (const auto& corners : triangles.rowwise()) {
    for (int i = 0; i < 3; ++i) {
      const int from = corners[i];
      const int to = corners[(i + 1) % 3];
      if (are_tangled[from] != 0 && are_tangled[to] != 0) sets.merge(from, to);
    }
  }
  std::vector<int> tangles(are_tangled.size());
  for (int vertex = 0; vertex < isize(tangles); ++vertex) {
    if (are_tangled[vertex] != 0) tangles[vertex] = sets.find(vertex) + 1;
  }
  return tangles;
}

}  // namespace sprung
