#include "core/contact/penetration.h"

#include <algorithm>
#include <optional>

#include "core/body/body.h"
#include "core/mesh/query/winding_tree.h"
#include "core/world/obstacle.h"

namespace sprung {
namespace {

/// Positions of the contact points that can move, m.
Points free_points(const SoftBody& body) {
  std::vector<bool> is_pinned(body.node_count());
  for (const KinematicNode& pinned : body.pinned) is_pinned[pinned.node] = true;
  const Points points = deform_points(body.grid, body.contact.points, body.positions);
  std::vector<int> rows;
  rows.reserve(points.rows());
  for (int point = 0; point < points.rows(); ++point) {
    const std::size_t brick = body.contact.points.brick[point];
    const auto& nodes = body.grid.nodes[brick];
    const bool is_free = std::any_of(nodes.begin(), nodes.end(), [&](int node) { return !is_pinned[node]; });
    if (is_free) rows.push_back(point);
  }
  return points(rows, Eigen::all);
}

/// The middles of the full bricks, m; those of others may be outside the body.
Points brick_middles(const Body& body) {
  constexpr double kFull = 0.99;
  std::vector<Vec3> middles;
  for (int brick = 0; brick < body.grid.brick_count(); ++brick) {
    if (body.grid.fill[brick] < kFull) continue;
    middles.emplace_back(columns_of(body.grid.nodes[brick], body.positions).rowwise().mean());
  }
  Points rows(middles.size(), 3);
  for (std::size_t row = 0; row < middles.size(); ++row) rows.row(Eigen::Index(row)) = middles[row];
  return rows;
}

/// The current surface of a body.
class Surface {
 public:
  /// `body` has contact triangles.
  explicit Surface(const SoftBody& body)
      : points_(deform_points(body.grid, body.contact.points, body.positions)),
        triangles_(body.contact.triangles),
        box_(bounding_box(points_)),
        distance_(points_, triangles_) {}

  /// Of the deepest point. Where a part is thinner than its triangles, the nearest of them may wrongly indicate inside:
  /// then the winding number decides.
  [[nodiscard]] double depth_of(const Points& points) const {
    double depth = 0;
    std::optional<WindingTree> winding;
    for (const auto& row : points.rowwise()) {
      const Vec3 place = row;
      if (!box_.contains(place)) continue;
      const double deep = -distance_.nearest(place).distance;
      if (deep <= depth) continue;
      if (!winding) winding.emplace(points_, triangles_);
      if (winding->at(place) > 0.5) depth = deep;
    }
    return depth;
  }

 private:
  Points points_;
  Triangles triangles_;
  AlignedBox box_;
  MeshDistance distance_;
};

}  // namespace

double penetration_depth(const Obstacle& obstacle, const SoftBody& body) {
  double depth = 0;
  const Points points = free_points(body);
  for (const auto& row : points.rowwise()) {
    depth = std::max(depth, -signed_distance(obstacle.shape, obstacle.pose, row).distance);
  }
  return depth;
}

double penetration_depth(const SoftBody& other, const SoftBody& body) {
  if (other.contact.triangles.rows() == 0) return 0;
  const Points points = free_points(body);
  if (points.rows() == 0) return 0;
  const Surface surface(other);
  return std::max(surface.depth_of(points), surface.depth_of(brick_middles(body)));
}

}  // namespace sprung
