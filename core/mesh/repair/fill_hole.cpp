#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <vector>

#include "core/mesh/repair/close_shells.h"

namespace sprung {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Corners = std::array<int, 3>;

constexpr double kFlat = 0.03;
constexpr int kWorthFairing = 8;  // edges

double extent_of(const Points& points) { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); }

bool is_flat(const Points& rim) {
  const Points centred = rim.rowwise() - rim.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(centred.transpose() * centred);
  return (centred * axes.eigenvectors().col(0)).cwiseAbs().maxCoeff() <= kFlat * extent_of(rim);
}

std::vector<Point> points_of(const Points& rows) {
  std::vector<Point> points;
  points.reserve(rows.rows());
  for (const auto& row : rows.rowwise()) points.emplace_back(row.x(), row.y(), row.z());
  return points;
}

/// Whether exactly the sides of the rim are open.
bool closes(const std::vector<Corners>& triangles, int corners) {
  std::map<std::array<int, 2>, int> sides;
  for (const Corners& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  for (int i = 0; i < corners; ++i) {
    const int next = (i + 1) % corners;
    sides[{std::min(i, next), std::max(i, next)}] -= i < next ? 1 : -1;
  }
  return std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 0; });
}

/// Without new points; empty if CGAL finds none.
std::vector<Corners> triangulate(const Hole& hole, bool flat) {
  std::vector<CGAL::Triple<int, int, int>> found;
  try {
    PMP::triangulate_hole_polyline(points_of(hole.rim), points_of(hole.beyond), std::back_inserter(found),
                                   CGAL::parameters::use_2d_constrained_delaunay_triangulation(flat));
  } catch (const std::exception&) {
    return {};
  }
  const int corners = int(hole.rim.rows());
  std::vector<Corners> triangles;
  triangles.reserve(found.size());
  for (const auto& t : found) triangles.push_back({t.first, t.second, t.third});
  if (closes(triangles, corners)) return triangles;
  for (Corners& t : triangles) std::swap(t[1], t[2]);
  return closes(triangles, corners) ? triangles : std::vector<Corners>{};
}

Triangles rows_of(const std::vector<Corners>& triangles) {
  Triangles rows(isize(triangles), 3);
  for (int t = 0; t < rows.rows(); ++t) {
    for (int k = 0; k < 3; ++k) rows(t, k) = triangles[t][k];
  }
  return rows;
}

Cap fan(const Points& rim) {
  const int corners = int(rim.rows());
  Cap cap{.points = rim.colwise().mean(), .triangles = Triangles(corners, 3), .flat = false};
  for (int i = 0; i < corners; ++i) cap.triangles.row(i) << i, (i + 1) % corners, corners;
  return cap;
}

/// The cap with the ring of triangles around it, as a mesh of CGAL's.
class Patch {
 public:
  /// Nothing if cap and ring do not make a manifold surface.
  static std::optional<Patch> make(const Hole& hole, const std::vector<Corners>& cap) {
    Patch patch;
    for (const Point& point : points_of(hole.rim)) patch.mesh_.add_vertex(point);
    const auto corners = int(hole.rim.rows());
    for (const Corners& t : cap) {
      const auto face = patch.mesh_.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
      if (face == Mesh::null_face()) return std::nullopt;
      patch.faces_.push_back(face);
    }
    const std::vector<Point> beyond = points_of(hole.beyond);
    for (int i = 0; i < corners; ++i) {
      // Consecutive triangles at the rim often share their third corner.
      const std::size_t here = i;
      const bool is_shared = i > 0 && beyond[here] == beyond[here - 1];
      const Vertex apex = is_shared ? Vertex(static_cast<Mesh::size_type>(patch.mesh_.number_of_vertices() - 1))
                                    : patch.mesh_.add_vertex(beyond[here]);
      if (patch.mesh_.add_face(vertex((i + 1) % corners), vertex(i), apex) == Mesh::null_face()) return std::nullopt;
    }
    return patch;
  }

  /// Whether fairing succeeded and stayed near the rim.
  bool refine_and_fair(const Points& rim) {
    std::vector<Mesh::Face_index> new_faces;
    std::vector<Vertex> inner;
    PMP::refine(mesh_, faces_, std::back_inserter(new_faces), std::back_inserter(inner));
    faces_.insert(faces_.end(), new_faces.begin(), new_faces.end());
    if (inner.empty() || !PMP::fair(mesh_, inner)) return false;
    const Eigen::RowVector3d middle = rim.colwise().mean();
    const double reach = extent_of(rim);
    return std::all_of(inner.begin(), inner.end(), [&](Vertex v) {
      const Point& p = mesh_.point(v);
      return (Eigen::RowVector3d(p.x(), p.y(), p.z()) - middle).norm() <= reach;
    });
  }

  [[nodiscard]] Cap cap(int corners) const {
    Cap cap;
    std::map<Vertex, int> rows;
    std::vector<Point> points;
    std::vector<Corners> triangles;
    for (const Mesh::Face_index face : faces_) {
      Corners t{};
      std::size_t k = 0;
      for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(face))) {
        const int row = int(v);
        const auto [place, is_new] = rows.try_emplace(v, row < corners ? row : corners + isize(points));
        if (is_new && row >= corners) points.push_back(mesh_.point(v));
        t[k++] = place->second;
      }
      triangles.push_back(t);
    }
    cap.triangles = rows_of(triangles);
    cap.points.resize(isize(points), 3);
    for (int p = 0; p < cap.points.rows(); ++p) {
      const Point& point = points[p];
      cap.points.row(p) << point.x(), point.y(), point.z();
    }
    return cap;
  }

 private:
  static Vertex vertex(int row) { return Vertex(static_cast<Mesh::size_type>(row)); }
  Mesh mesh_;
  std::vector<Mesh::Face_index> faces_;
};

std::optional<Cap> smooth_cap(const Hole& hole, const std::vector<Corners>& triangles) {
  try {
    std::optional<Patch> patch = Patch::make(hole, triangles);
    if (!patch || !patch->refine_and_fair(hole.rim)) return std::nullopt;
    return patch->cap(int(hole.rim.rows()));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

Cap fill_rounded(const Hole& hole) {
  const bool flat = is_flat(hole.rim);
  const std::vector<Corners> triangles = triangulate(hole, flat);
  if (triangles.empty()) return fan(hole.rim);
  if (!flat && hole.rim.rows() >= kWorthFairing) {
    if (std::optional<Cap> cap = smooth_cap(hole, triangles)) return *cap;
  }
  return {.points = Points(0, 3), .triangles = rows_of(triangles), .flat = flat};
}

/// The frame of the rim's position and size. Coordinates in it are rounded to 1e-9, so that the rounding errors of a
/// scaled or shifted mesh cannot change the triangulation.
class Frame {
 public:
  explicit Frame(const Points& rim) : origin_(rim.colwise().mean()), size_(extent_of(rim)) {}
  [[nodiscard]] Points rounded(const Points& points) const {
    const Points inside = (points.rowwise() - origin_) / size_;
    return (inside.array() * kSteps).round() / kSteps;
  }
  [[nodiscard]] Points placed(const Points& points) const { return (points * size_).rowwise() + origin_; }

 private:
  static constexpr double kSteps = 1 << 30;
  Eigen::RowVector3d origin_;
  double size_;
};

}  // namespace

Cap fill_hole(const Hole& given) {
  const Frame frame(given.rim);
  const Hole hole{frame.rounded(given.rim), frame.rounded(given.beyond)};
  Cap cap = fill_rounded(hole);
  cap.points = frame.placed(cap.points);
  return cap;
}

}  // namespace sprung
