#include "core/contact/pairs/feature_pairs.h"

#include <algorithm>

#include "core/contact/pairs/closest_features.h"

namespace sprung {
namespace {

constexpr double kNear = 0.35;  // bricks within which features are listed

/// Whether a box about some places comes within `margin` of one about others.
template <std::size_t N, std::size_t M>
bool are_near(const std::array<Vec3, N>& a, const std::array<Vec3, M>& b, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Vec3& one, const Vec3& other) { return one[axis] < other[axis]; };
    const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
    const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
    if ((*low_a)[axis] - (*high_b)[axis] > margin || (*low_b)[axis] - (*high_a)[axis] > margin) return false;
  }
  return true;
}

}  // namespace

FeaturePairs::FeaturePairs(SurfaceTree& a, SurfaceTree& b, std::array<std::size_t, 2> bodies)
    : trees_{a, b},
      bodies_(bodies),
      brick_(std::min(a.body().grid.brick_size, b.body().grid.brick_size)),
      front_(a, b, kNear * brick_, *this, &a == &b ? Facing::kNeeded : Facing::kIgnored) {}

bool FeaturePairs::fill(const NearBricks& bricks) {
  lists_.resize(std::max(lists_.size(), std::size_t(bricks.list) + 1));
  NearList& list = lists_[bricks.list];
  list = {.block = bricks.block};
  list_points(0, bricks.a, bricks.b, bricks.margin, list);
  list_points(is_self() ? 0 : 1, bricks.b, bricks.a, bricks.margin, list);
  list_edges(bricks.a, bricks.b, bricks.margin, list);
  return true;
}

bool FeaturePairs::clear(int list) {
  lists_[list].sleepers.clear();
  return true;
}

bool FeaturePairs::hangs_together(std::size_t point, std::size_t other) const {
  if (!is_self()) return false;
  const SurfaceTree& tree = trees_[0];
  const std::vector<ContactPoint>& points = tree.skin().points;
  return share_a_node(tree.body(), points[point].brick, points[other].brick);
}

void FeaturePairs::list_points(std::size_t side, int points_of, int triangles_of, double margin, NearList& list) {
  SurfaceTree& ours = tree(side);
  SurfaceTree& across = is_self() ? ours : tree(1 - side);
  const ContactSurface& skin = ours.skin();
  const ContactSurface& other = across.skin();
  for (int point = skin.first_point[points_of]; point < skin.first_point[points_of + 1]; ++point) {
    const std::array<Vec3, 1> place{ours.place_of(point)};
    for (int t = other.first_triangle[triangles_of]; t < other.first_triangle[triangles_of + 1]; ++t) {
      const auto& [a, b, c] = other.triangles[t];
      const std::array<Vec3, 3> corners{across.place_of(a), across.place_of(b), across.place_of(c)};
      if (!are_near(place, corners, margin)) continue;
      if (hangs_together(point, a) || hangs_together(point, b) || hangs_together(point, c)) continue;
      list.sleepers.push_back({{.count = 1, .corners = {point, a, b, c}, .first = side}, 0});
    }
  }
}

void FeaturePairs::list_edges(int edges_of, int others_of, double margin, NearList& list) {
  SurfaceTree& ours = tree(0);
  SurfaceTree& across = tree(1);
  const ContactSurface& skin = ours.skin();
  const ContactSurface& other = across.skin();
  for (int edge = skin.first_edge[edges_of]; edge < skin.first_edge[edges_of + 1]; ++edge) {
    const auto& [a, b] = skin.edges[edge];
    const std::array<Vec3, 2> ends{ours.place_of(a), ours.place_of(b)};
    for (int e = other.first_edge[others_of]; e < other.first_edge[others_of + 1]; ++e) {
      const auto& [c, d] = other.edges[e];
      if (!are_near(ends, std::array<Vec3, 2>{across.place_of(c), across.place_of(d)}, margin)) continue;
      if (hangs_together(a, c) || hangs_together(a, d) || hangs_together(b, c) || hangs_together(b, d)) continue;
      list.sleepers.push_back({{.count = 2, .corners = {a, b, c, d}, .first = 0}, 0});
    }
  }
}

AwakePair FeaturePairs::measure(const FeaturePair& pair) {
  std::array<Vec3, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = tree(pair.side(i)).place_of(pair.corners[i]);
  const FeatureDistance found =
      pair.count == 1 ? point_to_triangle(x[0], x[1], x[2], x[3]) : edge_to_edge(x[0], x[1], x[2], x[3]);
  const double gap = found.apart.norm();
  return {.pair = pair,
          .bodies = bodies_,
          .normal = found.apart / std::max(gap, 1e-300),
          .gap = gap,
          .weights = found.weights};
}

bool FeaturePairs::has_crossed(const AwakePair& pair) {
  const auto place = [&](int i) { return tree(pair.pair.side(i)).place_of(pair.pair.corners[i]); };
  const auto normal = [&](int i) { return tree(pair.pair.side(i)).normal_of(pair.pair.corners[i]); };
  const Vec3 outward = pair.pair.count == 1 ? Vec3((place(2) - place(1)).cross(place(3) - place(1)))
                                            : Vec3(normal(2) + normal(3) - normal(0) - normal(1));
  return outward.dot(pair.normal) < 0;
}

void FeaturePairs::wake() {
  static_cast<void>(front_.advance());
  awake_.clear();
  for (NearList& list : lists_) {
    if (list.sleepers.empty()) continue;
    const double closer = front_.closer(list.block);
    const double soon = closer + front_.moving_closer(list.block);
    if (list.first_wake > soon) continue;
    list.first_wake = std::numeric_limits<double>::infinity();
    for (Sleeper& sleeper : list.sleepers) {
      if (sleeper.wake <= soon) {
        const AwakePair pair = measure(sleeper.pair);
        const bool is_asleep = kFreeShare * (pair.gap - kLeastGap * brick_) > soon - closer;
        const bool is_crossed = !is_asleep && has_crossed(pair);
        sleeper.wake = is_asleep ? closer + kFreeShare * (pair.gap - kLeastGap * brick_) : closer;
        if (!is_asleep && !is_crossed) awake_.push_back(sleeper.pair);
      }
      list.first_wake = std::min(list.first_wake, sleeper.wake);
    }
  }
}

void FeaturePairs::measure(std::vector<AwakePair>& awake) {
  for (const FeaturePair& pair : awake_) awake.push_back(measure(pair));
}

}  // namespace sprung
