#include "core/mesh/repair/close_shells.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sprung {
namespace {

/// Caps have the opposite direction along an edge: `from` to `to` in the cap is `to` to `from` in the surface.
struct BoundaryLoop {
  std::vector<int> corners;
  std::vector<int> triangles;  // at the side from corner i to i + 1
};

/// Cuts walks along open sides into loops that visit no point twice.
class BoundaryWalker {
 public:
  explicit BoundaryWalker(const std::vector<OpenSide>& open) {
    for (const OpenSide& side : open) leaving_.emplace(side.to, Step{side.from, side.triangle});
  }

  std::vector<BoundaryLoop> rims() {
    while (!leaving_.empty()) walk_from(leaving_.begin()->first);
    return std::move(rims_);
  }

 private:
  struct Step {
    int to;
    int triangle;
  };

  void walk_from(int start) {
    std::vector<int> path{start};
    std::vector<int> triangles;
    std::map<int, std::size_t> place{{start, 0}};
    for (auto next = leaving_.find(start); next != leaving_.end(); next = leaving_.find(path.back())) {
      const Step step = next->second;
      leaving_.erase(next);
      triangles.push_back(step.triangle);
      const auto seen = place.find(step.to);
      if (seen == place.end()) {
        place.emplace(step.to, path.size());
        path.push_back(step.to);
        continue;
      }
      cut_off(seen->second, path, triangles, place);
    }
  }

  /// Cuts the loop that starts at `first` off the end of the path. Two sides on one edge need no cap.
  void cut_off(std::size_t first, std::vector<int>& path, std::vector<int>& triangles,
               std::map<int, std::size_t>& place) {
    const std::ptrdiff_t begin = first;
    BoundaryLoop rim{{path.begin() + begin, path.end()}, {triangles.begin() + begin, triangles.end()}};
    for (std::size_t i = first + 1; i < path.size(); ++i) place.erase(path[i]);
    path.resize(first + 1);
    triangles.resize(first);
    if (rim.corners.size() > 2) rims_.push_back(std::move(rim));
  }

  std::multimap<int, Step> leaving_;
  std::vector<BoundaryLoop> rims_;
};

Hole hole_of(const WeldedMesh& mesh, const BoundaryLoop& rim) {
  const auto corners = isize(rim.corners);
  Hole hole{mesh.points(rim.corners, Eigen::all), Points(corners, 3)};
  for (int i = 0; i < corners; ++i) {
    const int from = rim.corners[i];
    const int to = rim.corners[(i + 1) % corners];
    const int apex = mesh.triangles.row(rim.triangles[i]).sum() - from - to;
    hole.beyond.row(i) = mesh.points.row(apex);
  }
  return hole;
}

double area_of(const Points& points, const Triangles& triangles) {
  double area = 0;
  for (int t = 0; t < triangles.rows(); ++t) area += triangle_area(points, triangles, t);
  return area;
}

/// Triangles and points to be added to a mesh, all at once.
struct Added {
  std::vector<Points> points;
  std::vector<Triangles> triangles;
  int point_count = 0;
  int triangle_count = 0;
};

/// The cap's triangles, as rows of the mesh's points.
Triangles placed(const Cap& cap, const BoundaryLoop& rim, int first_new) {
  Triangles triangles = cap.triangles;
  const auto corners = isize(rim.corners);
  for (int& row : triangles.reshaped()) {
    row = row < corners ? rim.corners[row] : first_new + row - corners;
  }
  return triangles;
}

void append(const Added& added, WeldedMesh& mesh) {
  Eigen::Index point = mesh.points.rows();
  Eigen::Index triangle = mesh.triangles.rows();
  mesh.points.conservativeResize(point + added.point_count, 3);
  mesh.triangles.conservativeResize(triangle + added.triangle_count, 3);
  for (std::size_t i = 0; i < added.points.size(); ++i) {
    mesh.points.middleRows(point, added.points[i].rows()) = added.points[i];
    mesh.triangles.middleRows(triangle, added.triangles[i].rows()) = added.triangles[i];
    point += added.points[i].rows();
    triangle += added.triangles[i].rows();
  }
  mesh.source.resize(triangle, -1);
  mesh.flipped.resize(triangle, false);
}

}  // namespace

Closing close_shells(WeldedMesh& mesh, SurfaceComponents& shells) {
  Closing closing;
  std::map<int, std::vector<OpenSide>> open;
  for (const OpenSide& side : shells.open) open[side.shell].push_back(side);
  const auto old_points = int(mesh.points.rows());
  const auto old_triangles = int(mesh.triangles.rows());
  Added added;
  for (const auto& [shell, sides] : open) {
    for (const BoundaryLoop& rim : BoundaryWalker(sides).rims()) {
      const Cap cap = fill_hole(hole_of(mesh, rim));
      Points corners(mesh.points(rim.corners, Eigen::all));
      Points all(corners.rows() + cap.points.rows(), 3);
      all << corners, cap.points;
      closing.largest_cap = std::max(closing.largest_cap, area_of(all, cap.triangles));
      ++(cap.flat ? closing.flat : closing.smooth);
      std::vector<int>& rows = shells.shells[shell].triangles;
      for (int t = 0; t < cap.triangles.rows(); ++t) rows.push_back(old_triangles + added.triangle_count + t);
      added.triangles.push_back(placed(cap, rim, old_points + added.point_count));
      added.points.push_back(cap.points);
      added.point_count += int(cap.points.rows());
      added.triangle_count += int(cap.triangles.rows());
    }
  }
  append(added, mesh);
  for (const auto& [shell, sides] : open) {
    measure(mesh.points, mesh.triangles, shells.shells[shell]);
  }
  shells.open.clear();
  return closing;
}

}  // namespace sprung
