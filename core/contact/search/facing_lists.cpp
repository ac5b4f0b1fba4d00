#include "core/contact/search/facing_lists.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr double kMayFace = 0.9;  // largest cosine between normals that may turn to kFacing while a list is valid

}  // namespace

bool FacingLists::fill(const NearBricks& bricks) {
  lists_.resize(std::max(lists_.size(), std::size_t(bricks.list) + 1));
  std::vector<FacingPair> found;
  list_side(0, bricks.a, bricks.b, bricks.margin, found);
  list_side(is_self() ? 0 : 1, bricks.b, bricks.a, bricks.margin, found);
  std::swap(lists_[bricks.list], found);
  return !found.empty() || !lists_[bricks.list].empty();
}

bool FacingLists::clear(int list) {
  const bool changed = !lists_[list].empty();
  lists_[list].clear();
  return changed;
}

void FacingLists::list_side(std::size_t side, int points_of, int triangles_of, double margin,
                            std::vector<FacingPair>& list) {
  SurfaceTree& ours = tree(side);
  SurfaceTree& across = is_self() ? ours : tree(1 - side);
  const ContactSurface& skin = ours.skin();
  const ContactSurface& other = across.skin();
  for (int point = skin.first_point[points_of]; point < skin.first_point[points_of + 1]; ++point) {
    const Vec3& position = ours.position_of(point);
    const auto is_connected = [&](int corner) {
      return share_a_node(ours.body(), skin.points[point].brick, other.points[corner].brick);
    };
    for (int t = other.first_triangle[triangles_of]; t < other.first_triangle[triangles_of + 1]; ++t) {
      const std::array<int, 3>& triangle = other.triangles[t];
      const Vec3& a = across.position_of(triangle[0]);
      const Vec3& b = across.position_of(triangle[1]);
      const Vec3& c = across.position_of(triangle[2]);
      if (((a.cwiseMin(b).cwiseMin(c) - position).array() > margin).any()) continue;
      if (((position - a.cwiseMax(b).cwiseMax(c)).array() > margin).any()) continue;
      const Vec3 area = (b - a).cross(c - a);
      if (area.dot(position - a) < -(deepest_ + margin) * area.norm()) continue;
      if (ours.normal_of(point).dot(area) > kMayFace * area.norm()) continue;
      if (is_self() && std::any_of(triangle.begin(), triangle.end(), is_connected)) continue;
      list.push_back({side, point, t});
    }
  }
}

}  // namespace sprung
