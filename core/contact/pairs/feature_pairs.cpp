#include "core/contact/pairs/feature_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/pairs/closest_features.h"
#include "core/contact/search/segment_crossing.h"

namespace sprung {
namespace {

constexpr double kNear = 0.35;    // bricks within which features are listed ...
constexpr double kSeen = 2;       // ... and times as far, within which their distance is measured
constexpr double kBeside = 1e-6;  // of a feature's corners: the nearest point is on its edge if one has less weight
constexpr double kStill = 0.4;    // of its gap, that a point may move while only one of the triangles about it is awake
constexpr double kSame = 1e-3;    // bricks by which two triangles are about as near to a point
constexpr double kTouching = 1e-6;  // bricks: the direction between nearest points is then a rounding error

/// Whether the nearest points of two edges are at an end of one: such contacts are left to points.
bool is_at_end(const AwakePair& edges) { return edges.weights.cwiseAbs().minCoeff() <= kBeside; }

/// Whether the nearest point of a triangle is on one of its sides.
bool is_beside(const AwakePair& pair) { return pair.weights.tail<3>().maxCoeff() >= -kBeside; }

}  // namespace

FeaturePairs::FeaturePairs(SurfaceTree& a, SurfaceTree& b, std::array<std::size_t, 2> bodies, double friction,
                           Joints joints)
    : trees_{a, b},
      bodies_(bodies),
      friction_(friction),
      joints_(std::move(joints)),
      brick_(std::min(a.body().grid.brick_size, b.body().grid.brick_size)),
      front_(a, b, kNear * brick_, *this) {}

void FeaturePairs::make_tables() {
  for (std::size_t side = 0; side < 2; ++side) {
    nearest_[side].resize(tree(side).skin().points.size());
    inside_[side].resize(tree(side).skin().points.size());
    loaded_[side].resize(std::size_t(tree(side).body().node_count()), -1);
  }
}

bool FeaturePairs::fill(const NearBricks& bricks) {
  if (lists_.empty()) make_tables();
  lists_.resize(std::max(lists_.size(), std::size_t(bricks.list) + 1));
  NearList& list = lists_[bricks.list];
  std::vector<Sleeper> before = std::move(list.sleepers);
  list = {.margin = bricks.margin, .unlisted = kSeen * bricks.margin};
  list_points(0, bricks.a, bricks.b, list);
  list_points(is_self() ? 0 : 1, bricks.b, bricks.a, list);
  list_edges(bricks.a, bricks.b, list);
  for (const Sleeper& old : before) {
    if (old.impulse.isZero(0)) continue;
    const auto known = std::find_if(list.sleepers.begin(), list.sleepers.end(), [&](const Sleeper& sleeper) {
      return sleeper.pair.corners == old.pair.corners && sleeper.pair.count == old.pair.count &&
             sleeper.pair.first == old.pair.first;
    });
    if (known != list.sleepers.end()) known->impulse = old.impulse;
  }
  return true;
}

bool FeaturePairs::clear(int list) {
  lists_[list].sleepers.clear();
  return true;
}

bool FeaturePairs::are_connected(std::size_t side, int point, int other) const {
  const SurfaceTree& ours = trees_[side];
  const SurfaceTree& across = trees_[1 - side];
  const int brick = ours.skin().points[point].brick;
  const int other_brick = across.skin().points[other].brick;
  if (is_self()) return share_a_node(ours.body(), brick, other_brick);
  return std::any_of(joints_.begin(), joints_.end(), [&](const std::array<int, 2>& glued) {
    return share_a_node(ours.body(), brick, glued[side]) && share_a_node(across.body(), other_brick, glued[1 - side]);
  });
}

template <class Feature>
AlignedBox FeaturePairs::find_boxes(SurfaceTree& tree, const std::vector<Feature>& features, int first, int last) {
  boxes_.clear();
  AlignedBox all;
  for (int row = first; row < last; ++row) {
    AlignedBox& box = boxes_.emplace_back();
    for (const int corner : features[row]) box.extend(tree.position_of(corner));
    all.extend(box);
  }
  return all;
}

void FeaturePairs::list_points(std::size_t side, int points_of, int triangles_of, NearList& list) {
  SurfaceTree& ours = tree(side);
  SurfaceTree& across = is_self() ? ours : tree(1 - side);
  const ContactSurface& skin = ours.skin();
  const ContactSurface& other = across.skin();
  const int first = other.first_triangle[triangles_of];
  const int last = other.first_triangle[triangles_of + 1];
  if (first == last) return;
  const AlignedBox all = find_boxes(across, other.triangles, first, last);
  for (int point = skin.first_point[points_of]; point < skin.first_point[points_of + 1]; ++point) {
    const AlignedBox box(ours.position_of(point));
    if (box.exteriorDistance(all) >= list.unlisted) continue;
    for (int t = first; t < last; ++t) {
      const double distance = box.exteriorDistance(boxes_[t - first]);
      if (distance >= list.unlisted) continue;
      const auto& [a, b, c] = other.triangles[t];
      if (are_connected(side, point, a) || are_connected(side, point, b) || are_connected(side, point, c)) continue;
      list.add({.count = 1, .corners = {point, a, b, c}, .first = side}, distance);
    }
  }
}

void FeaturePairs::list_edges(int edges_of, int others_of, NearList& list) {
  SurfaceTree& ours = tree(0);
  SurfaceTree& across = tree(1);
  const ContactSurface& skin = ours.skin();
  const ContactSurface& other = across.skin();
  const int first = other.first_edge[others_of];
  const int last = other.first_edge[others_of + 1];
  if (first == last) return;
  const AlignedBox all = find_boxes(across, other.edges, first, last);
  for (int edge = skin.first_edge[edges_of]; edge < skin.first_edge[edges_of + 1]; ++edge) {
    const auto& [a, b] = skin.edges[edge];
    AlignedBox box(ours.position_of(a));
    box.extend(ours.position_of(b));
    if (box.exteriorDistance(all) >= list.unlisted) continue;
    for (int e = first; e < last; ++e) {
      const double distance = box.exteriorDistance(boxes_[e - first]);
      if (distance >= list.unlisted) continue;
      const auto& [c, d] = other.edges[e];
      if (are_connected(0, a, c) || are_connected(0, a, d)) continue;
      if (are_connected(0, b, c) || are_connected(0, b, d)) continue;
      list.add({.count = 2, .corners = {a, b, c, d}, .first = 0}, distance);
    }
  }
}

double FeaturePairs::reach_of(const FeaturePair& pair) {
  const auto height_at = [&](int first, int last) {
    double lowest = std::numeric_limits<double>::infinity();
    for (int i = first; i < last; ++i) {
      lowest = std::min(lowest, tree(pair.side(i)).height_about(pair.corners[i]));
    }
    return lowest;
  };
  const double gap = (pair.count == 1 ? kGuardedGap : kGuardedEdges) * brick_;
  return gap + height_at(0, pair.count) + height_at(pair.count, 4);
}

AwakePair FeaturePairs::measure(const FeaturePair& pair) {
  std::array<Vec3, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = tree(pair.side(i)).position_of(pair.corners[i]);
  const FeatureDistance found = feature_distance(pair.count, x);
  const double gap = found.apart.norm();
  AwakePair measured{.pair = pair,
                     .bodies = bodies_,
                     .normal = found.apart / std::max(gap, 1e-300),
                     .gap = gap,
                     .weights = found.weights,
                     .reach = reach_of(pair),
                     .friction = friction_};
  if (gap < kTouching * brick_) measured.normal = normal_of_touching(measured);
  return measured;
}

Vec3 FeaturePairs::facing_of(const AwakePair& pair) {
  Vec3 facing = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    if (pair.weights[i] != 0) facing -= pair.weights[i] * tree(pair.pair.side(i)).normal_of(pair.pair.corners[i]);
  }
  return facing;
}

Vec3 FeaturePairs::normal_of_touching(const AwakePair& pair) {
  const Vec3 facing = facing_of(pair);
  const auto position = [&](int i) { return tree(pair.pair.side(i)).position_of(pair.pair.corners[i]); };
  Vec3 across = Vec3::Zero();
  if (pair.pair.count == 1 && !is_beside(pair)) across = outward_normal(pair);
  if (pair.pair.count == 2 && !is_at_end(pair)) across = (position(1) - position(0)).cross(position(3) - position(2));
  if (across.isZero(0)) return facing.normalized();
  return (across.dot(facing) < 0 ? -1 : 1) * across.normalized();
}

bool FeaturePairs::pierces(const AwakePair& edges, int edge) {
  const int other = 2 - edge;
  const auto& corners = edges.pair.corners;
  const auto position = [&](int i) { return tree(edges.pair.side(i)).position_of(corners[i]); };
  SurfaceTree& across = tree(edges.pair.side(other));
  const ContactSurface& skin = across.skin();
  for (const int third : skin.opposite[skin.row_of_edge(corners[other], corners[other + 1])]) {
    if (third < 0 || (is_self() && (third == corners[edge] || third == corners[edge + 1]))) continue;
    const int crossing = segment_crossing(position(edge), position(edge + 1), position(other), position(other + 1),
                                          across.position_of(third));
    if (crossing != 0) return true;
  }
  return false;
}

Vec3 FeaturePairs::outward_normal(const AwakePair& pair) {
  const auto position = [&](int i) { return tree(pair.pair.side(i)).position_of(pair.pair.corners[i]); };
  return (position(2) - position(1)).cross(position(3) - position(1));
}

bool FeaturePairs::is_inside(const AwakePair& pair) {
  if (is_beside(pair) || outward_normal(pair).dot(pair.normal) >= 0) return false;
  const int point = pair.pair.corners[0];
  Inside& inside = inside_[pair.pair.first][point];
  if (inside.look != look_) {
    SurfaceTree& ours = tree(pair.pair.first);
    const Vec3& position = ours.position_of(point);
    inside = {look_, is_self() ? ours.winding_number(position, ours.normal_of(point), point) > 0
                               : tree(1 - pair.pair.first).encloses(position)};
  }
  return inside.value;
}

void FeaturePairs::wake() {
  static_cast<void>(front_.advance());
  ++look_;
  woken_.clear();
  measured_.clear();
  for (int row = 0; row < isize(lists_); ++row) {
    NearList& list = lists_[row];
    if (list.sleepers.empty()) continue;
    const double closer = front_.closer(row);
    const double coming = front_.moving_closer(row);
    // The gap that a pair keeps grows with the heights of the drawn skins.
    const bool may_have_grown = (look_ + row) % SurfaceTree::kHeightLooks == 0;
    if (list.first_wake > closer + coming && !may_have_grown) continue;
    list.first_wake = std::numeric_limits<double>::infinity();
    for (Sleeper& sleeper : list.sleepers) {
      if (sleeper.wake <= closer + coming || may_have_grown) look_at(sleeper, closer, coming);
      list.first_wake = std::min(list.first_wake, sleeper.wake);
    }
  }
  choose_supports(measured_);
  for (std::size_t row = 0; row < woken_.size(); ++row) {
    if (measured_[row].is_loaded) loaded_at(measured_[row]) = step_;
  }
  awake_.clear();
  for (std::size_t row = 0; row < woken_.size(); ++row) {
    if (may_skip(measured_[row], woken_[row])) continue;
    measured_[awake_.size()] = measured_[row];
    measured_[awake_.size()].may_support = woken_[row].may_support;
    awake_.push_back(woken_[row].sleeper);
  }
  measured_.resize(awake_.size());
  are_measured_ = true;
}

long& FeaturePairs::loaded_at(const AwakePair& pair) {
  const std::size_t side = pair.pair.first;
  const ContactPoint& point = tree(side).skin().points[pair.pair.corners[0]];
  return loaded_[side][tree(side).body().grid.nodes[point.brick][point.corner]];
}

bool FeaturePairs::may_skip(const AwakePair& pair, const Woken& woken) {
  if (pair.pair.count == 2) return false;
  if (!pair.may_support) return pair.gap < 0 || woken.coming < kStill * pair.gap;
  if (pair.is_loaded || pair.gap < kBorne * pair.reach) return false;
  if (loaded_at(pair) != step_) return false;
  if (!(woken.coming < kSkipped * pair.gap)) return false;
  woken.sleeper->wake += kSkipped * pair.gap;
  return true;
}

bool FeaturePairs::stays_apart(Sleeper& sleeper, double closer, double coming) {
  if (sleeper.normal.isZero(0) || !sleeper.impulse.isZero(0)) return false;
  const FeaturePair& pair = sleeper.pair;
  Eigen::Vector4d heights;
  for (int i = 0; i < 4; ++i) heights[i] = sleeper.normal.dot(tree(pair.side(i)).position_of(pair.corners[i]));
  const double way = distance_until_due(-closing_speed(pair, heights), reach_of(pair), brick_);
  if (way > coming) {
    sleeper.wake = closer + way;
    return true;
  }
  sleeper.wake = closer;
  return way > 0 && way > coming_closer(pair, sleeper.normal);
}

void FeaturePairs::look_at(Sleeper& sleeper, double closer, double coming) {
  if (stays_apart(sleeper, closer, coming)) return;
  AwakePair pair = measure(sleeper.pair);
  const bool is_point = pair.pair.count == 1;
  const double reach = !is_point && is_at_end(pair) ? 0 : pair.reach;
  const double way = distance_until_due(pair.gap, reach, brick_);
  if (is_point) {
    sleeper.is_inside = is_inside(pair);
    orient(pair, sleeper.is_inside);
  }
  const bool may_sleep = sleeper.impulse.isZero(0) && pair.gap > 0;
  const bool is_asleep = may_sleep && way > coming;
  sleeper.wake = is_asleep ? closer + way : closer;
  sleeper.normal = may_sleep ? pair.normal : Vec3(Vec3::Zero());
  if (is_asleep || (may_sleep && way > coming_closer(pair.pair, pair.normal))) return;
  if (!is_point && (pierces(pair, 0) || pierces(pair, 2))) return;
  pair.is_loaded = !sleeper.impulse.isZero(0);
  pair.impulse = &sleeper.impulse;
  woken_.push_back({&sleeper, coming, pair.may_support});
  measured_.push_back(pair);
}

double FeaturePairs::coming_closer(const FeaturePair& pair, const Vec3& normal) {
  Eigen::Vector4d speeds;
  for (int i = 0; i < 4; ++i) speeds[i] = normal.dot(tree(pair.side(i)).velocity_of(pair.corners[i]));
  const SurfaceTree& ours = trees_[0];
  const SurfaceTree& others = trees_[1];
  return ours.time_ahead() * std::max(0.0, closing_speed(pair, speeds)) + ours.distance_ahead() +
         others.distance_ahead();
}

void FeaturePairs::orient(AwakePair& pair, bool is_inside) {
  const Vec3 outward = outward_normal(pair);
  if (outward.dot(pair.normal) >= 0) return;
  pair.may_support = !is_beside(pair);
  if (!is_inside || !pair.may_support) return;
  pair.normal = outward.normalized();
  pair.gap = -pair.gap;
}

void FeaturePairs::measure_awake() {
  measured_.clear();
  for (Sleeper* sleeper : awake_) {
    AwakePair pair = measure(sleeper->pair);
    if (pair.pair.count == 1) orient(pair, sleeper->is_inside);
    pair.is_loaded = !sleeper->impulse.isZero(0);
    pair.impulse = &sleeper->impulse;
    measured_.push_back(pair);
  }
}

void FeaturePairs::measure(std::vector<AwakePair>& awake) {
  if (!are_measured_) measure_awake();
  are_measured_ = false;
  choose_supports(measured_);
  for (const AwakePair& pair : measured_) {
    if (pair.gap > 0 || pair.may_support) awake.push_back(pair);
  }
}

void FeaturePairs::choose_supports(std::vector<AwakePair>& pairs) {
  ++step_;
  const auto nearest_of = [&](const AwakePair& pair) -> Nearest& {
    return nearest_[pair.pair.first][pair.pair.corners[0]];
  };
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    const AwakePair& pair = pairs[row];
    if (pair.pair.count == 2 || !pair.may_support) continue;
    Nearest& nearest = nearest_of(pair);
    // Among equally near triangles, the one that carries the load keeps it.
    const double slack = kSame * brick_ * (int(nearest.is_loaded) - int(pair.is_loaded));
    if (nearest.step == step_ && !(std::abs(pair.gap) < nearest.distance - slack)) continue;
    nearest = {step_, std::abs(pair.gap), row, pair.is_loaded};
  }
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    AwakePair& pair = pairs[row];
    if (pair.pair.count == 2) {
      pair.may_support = !is_at_end(pair) && facing_of(pair).dot(pair.normal) >= 0;
    } else if (pair.may_support) {
      pair.may_support = nearest_of(pair).row == row || (pair.gap > 0 && !is_beside(pair));
    }
  }
}

}  // namespace sprung
