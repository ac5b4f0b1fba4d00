#include "core/world/skin_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/bricks/corner.h"
#include "core/world/near_boxes.h"

namespace sprung {
namespace {

constexpr double kMargin = 0.5;   // bricks: what is nearer than that is watched
constexpr double kDeepest = 0.7;  // bricks: what is deeper came from the other side
constexpr double kFacing = 0.2;   // cosine between the normals of what touches, at most
constexpr double kBent = 0.3;     // rad, that a brick's normals may turn against each other
constexpr double kBeside = 0.05;  // of a triangle: what stands a little beside it counts as over it

double smallest_brick(const Group& group) {
  double size = std::numeric_limits<double>::infinity();
  for (const Actor* actor : group) size = std::min(size, actor->body.grid.brick_size);
  return size;
}

/// Of any node, m/s, seen from the middle of all.
double fastest(const Group& group) {
  Vec3 momentum = Vec3::Zero();
  double mass = 0;
  for (const Actor* actor : group) {
    momentum += actor->body.velocities.transpose() * actor->body.masses;
    mass += actor->body.masses.sum();
  }
  const Vec3 mean = momentum / mass;
  double most = 0;
  for (const Actor* actor : group) {
    most = std::max(most, (actor->body.velocities.rowwise() - mean.transpose()).rowwise().squaredNorm().maxCoeff());
  }
  return std::sqrt(most);
}

/// The mean axes of a brick (columns), each from its low to its high side.
Mat3 mean_axes(const std::array<int, 8>& nodes, const Points& positions) {
  Mat3 axes = Mat3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place = positions.row(nodes[static_cast<std::size_t>(corner)]);
    for (int axis = 0; axis < 3; ++axis) axes.col(axis) += (on_high_side(corner, axis) ? 0.25 : -0.25) * place;
  }
  return axes;
}

/// A normal of the skin at rest carried along by its brick, unit.
Vec3 carried_normal(const Body& body, int brick, const Vec3& normal) {
  const auto& nodes = body.grid.nodes[static_cast<std::size_t>(brick)];
  const Mat3 now = mean_axes(nodes, body.positions);
  const Vec3 along = mean_axes(nodes, body.rest_positions).transpose() * normal;
  return (along.x() * now.col(1).cross(now.col(2)) + along.y() * now.col(2).cross(now.col(0)) +
          along.z() * now.col(0).cross(now.col(1)))
      .normalized();
}

bool hang_together(const Body& body, int a, int b) {
  const auto brick_a = static_cast<std::size_t>(a);
  const auto brick_b = static_cast<std::size_t>(b);
  if ((body.grid.cells[brick_a] - body.grid.cells[brick_b]).cwiseAbs().maxCoeff() > 1) return false;
  const auto& nodes = body.grid.nodes[brick_b];
  return std::any_of(body.grid.nodes[brick_a].begin(), body.grid.nodes[brick_a].end(),
                     [&](int node) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); });
}

Points positions_of(const ContactSkin& skin, const Body& body) {
  Points all(static_cast<Eigen::Index>(skin.points.size()), 3);
  for (std::size_t i = 0; i < skin.points.size(); ++i) {
    all.row(static_cast<Eigen::Index>(i)) = carried(body, skin.points[i], body.positions).transpose();
  }
  return all;
}

/// Of the points and triangles of a skin's brick.
AlignedBox box_of(const ContactSkin& skin, std::size_t row, const Points& positions) {
  AlignedBox box;
  for (int i = skin.first_point[row]; i < skin.first_point[row + 1]; ++i) box.extend(Vec3(positions.row(i)));
  for (int i = skin.first_triangle[row]; i < skin.first_triangle[row + 1]; ++i) {
    for (const int corner : skin.triangles[static_cast<std::size_t>(i)]) box.extend(Vec3(positions.row(corner)));
  }
  return box;
}

AlignedBox widened(const AlignedBox& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

}  // namespace

bool SkinContact::may_touch(const World& world, const Group& group, const Place& a, const Place& b) const {
  const NormalCone& cone_a = skins_[a.actor].cones[a.row];
  const NormalCone& cone_b = skins_[b.actor].cones[b.row];
  const double angle = std::acos(std::clamp(a.normal.dot(b.normal), -1.0, 1.0));
  if (angle + cone_a.spread + cone_b.spread + kBent < std::acos(kFacing)) return false;
  if (a.actor != b.actor) return world.bodies_touch;
  const Actor& actor = *group[a.actor];
  const std::vector<int>& bricks = skins_[a.actor].bricks;
  return actor.touches_itself && !hang_together(actor.body, bricks[a.row], bricks[b.row]);
}

std::vector<std::pair<int, int>> SkinContact::near_bricks(const World& world, const Group& group, double margin) {
  positions_.clear();
  places_.clear();
  std::vector<AlignedBox> boxes;
  for (std::size_t actor = 0; actor < group.size(); ++actor) {
    const Body& body = group[actor]->body;
    const ContactSkin& skin = skins_[actor];
    positions_.push_back(positions_of(skin, body));
    for (std::size_t row = 0; row < skin.bricks.size(); ++row) {
      const AlignedBox box = box_of(skin, row, positions_[actor]);
      places_.push_back({actor, row, box, carried_normal(body, skin.bricks[row], skin.cones[row].axis)});
      boxes.push_back(widened(box, margin / 2));
    }
  }
  std::vector<std::pair<int, int>> near = overlapping_boxes(boxes);
  std::erase_if(near, [&](const std::pair<int, int>& pair) {
    return !may_touch(world, group, places_[static_cast<std::size_t>(pair.first)],
                      places_[static_cast<std::size_t>(pair.second)]);
  });
  return near;
}

int SkinContact::watched_row(const Group& group, std::size_t actor, int point) {
  int& row = rows_[actor][static_cast<std::size_t>(point)];
  if (row < 0) {
    row = static_cast<int>(watched_.size());
    const ContactSkin& skin = skins_[actor];
    const int brick = skin.points[static_cast<std::size_t>(point)].brick;
    watched_.push_back({actor, point, carried_normal(group[actor]->body, brick, skin.normals.row(point))});
  }
  return row;
}

void SkinContact::pair_up(const Group& group, const Place& place, const Place& facing, double margin) {
  const ContactSkin& skin = skins_[place.actor];
  const ContactSkin& across = skins_[facing.actor];
  const Points& points = positions_[place.actor];
  const Points& corners = positions_[facing.actor];
  const AlignedBox reach = widened(facing.box, margin);
  const double deepest = margin * (1 + kDeepest / kMargin);
  for (int p = skin.first_point[place.row]; p < skin.first_point[place.row + 1]; ++p) {
    const Vec3 point = points.row(p);
    if (!reach.contains(point)) continue;
    const int brick = skin.points[static_cast<std::size_t>(p)].brick;
    const auto hangs_together = [&](int corner) {
      return hang_together(group[place.actor]->body, brick, across.points[static_cast<std::size_t>(corner)].brick);
    };
    for (int t = across.first_triangle[facing.row]; t < across.first_triangle[facing.row + 1]; ++t) {
      const std::array<int, 3>& triangle = across.triangles[static_cast<std::size_t>(t)];
      const Vec3 a = corners.row(triangle[0]);
      const Vec3 b = corners.row(triangle[1]);
      const Vec3 c = corners.row(triangle[2]);
      if (((a.cwiseMin(b).cwiseMin(c) - point).array() > margin).any()) continue;
      if (((point - a.cwiseMax(b).cwiseMax(c)).array() > margin).any()) continue;
      const Vec3 area = (b - a).cross(c - a);
      if (area.dot(point - a) < -deepest * area.norm()) continue;
      const int row = watched_row(group, place.actor, p);
      if (watched_[static_cast<std::size_t>(row)].normal.dot(area) > kFacing * area.norm()) continue;
      if (place.actor == facing.actor && std::any_of(triangle.begin(), triangle.end(), hangs_together)) continue;
      Pair pair{row, {}};
      for (std::size_t i = 0; i < 3; ++i) pair.corners[i] = watched_row(group, facing.actor, triangle[i]);
      pairs_.push_back(pair);
    }
  }
}

void SkinContact::look(const World& world, double dt, const Group& group) {
  const double margin = kMargin * smallest_brick(group);
  steps_to_look_ = steps_until_look(margin, fastest(group), dt);
  watched_.clear();
  pairs_.clear();
  rows_.resize(group.size());
  for (std::size_t actor = 0; actor < group.size(); ++actor) rows_[actor].assign(skins_[actor].points.size(), -1);
  for (const auto& [brick, other] : near_bricks(world, group, margin)) {
    const Place& a = places_[static_cast<std::size_t>(brick)];
    const Place& b = places_[static_cast<std::size_t>(other)];
    pair_up(group, a, b, margin);
    pair_up(group, b, a, margin);
  }
  const auto order = [&](const Pair& pair) {
    const Watched& point = watched_[static_cast<std::size_t>(pair.point)];
    const Watched& corner = watched_[static_cast<std::size_t>(pair.corners[0])];
    return std::tuple(point.actor, point.point, corner.actor, pair.corners);
  };
  std::sort(pairs_.begin(), pairs_.end(), [&](const Pair& a, const Pair& b) { return order(a) < order(b); });
}

bool SkinContact::stand(const Pair& pair, double depth, Stance& stance) const {
  const Watched& point = watched_[static_cast<std::size_t>(pair.point)];
  std::array<const Watched*, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = &watched_[static_cast<std::size_t>(pair.corners[i])];
  const Vec3 ahead = corners[1]->place - corners[0]->place;
  const Vec3 aside = corners[2]->place - corners[0]->place;
  const Vec3 area = ahead.cross(aside);
  const double size = area.norm();
  const Vec3 off = point.place - corners[0]->place;
  stance.pair = &pair;
  stance.normal = area / size;
  stance.gap = stance.normal.dot(off);
  stance.weights.y() = off.cross(aside).dot(area) / (size * size);
  stance.weights.z() = ahead.cross(off).dot(area) / (size * size);
  stance.weights.x() = 1 - stance.weights.y() - stance.weights.z();
  return stance.gap > -depth && stance.weights.minCoeff() > -kBeside;  // not where the triangle has no area
}

void SkinContact::add_shares(const Group& group, const Watched& watched, double weight, Touches& touches) const {
  const ContactPoint& point = skins_[watched.actor].points[static_cast<std::size_t>(watched.point)];
  const auto& nodes = group[watched.actor]->body.grid.nodes[static_cast<std::size_t>(point.brick)];
  for (int i = 0; i < 8; ++i) {
    touches.shares.push_back(
        {static_cast<int>(watched.actor), nodes[static_cast<std::size_t>(i)], weight * point.weights[i]});
  }
}

/// Shares of one node are one.
void SkinContact::add(const Group& group, const Stance& stance, std::uint64_t key, Touches& touches) const {
  const std::size_t first = touches.shares.size();
  const Watched& point = watched_[static_cast<std::size_t>(stance.pair->point)];
  const Watched& corner = watched_[static_cast<std::size_t>(stance.pair->corners[0])];
  add_shares(group, point, 1, touches);
  for (std::size_t i = 0; i < 3; ++i) {
    add_shares(group, watched_[static_cast<std::size_t>(stance.pair->corners[i])],
               -stance.weights[static_cast<Eigen::Index>(i)], touches);
  }
  const auto begin = touches.shares.begin() + static_cast<std::ptrdiff_t>(first);
  const auto node_of = [](const Share& share) { return std::pair(share.actor, share.node); };
  std::stable_sort(begin, touches.shares.end(),
                   [&](const Share& a, const Share& b) { return node_of(a) < node_of(b); });
  auto kept = begin;
  for (auto next = begin + 1; next != touches.shares.end(); ++next) {
    if (node_of(*next) == node_of(*kept)) {
      kept->weight += next->weight;
    } else {
      *++kept = *next;
    }
  }
  touches.shares.erase(kept + 1, touches.shares.end());
  touches.list.push_back({.key = key,
                          .first = first,
                          .last = touches.shares.size(),
                          .normal = stance.normal,
                          .goal = stance.least_speed * stance.normal,
                          .friction = std::sqrt(group[point.actor]->friction * group[corner.actor]->friction)});
}

void SkinContact::follow(const Group& group) {
  for (Watched& watched : watched_) {
    const ContactPoint& point = skins_[watched.actor].points[static_cast<std::size_t>(watched.point)];
    const Body& body = group[watched.actor]->body;
    watched.place = carried(body, point, body.positions);
    watched.velocity = carried(body, point, body.velocities);
  }
}

std::size_t SkinContact::other_of(const Pair& pair) const {
  return watched_[static_cast<std::size_t>(pair.corners[0])].actor;
}

std::size_t SkinContact::end_of_run(std::size_t first) const {
  std::size_t end = first + 1;
  while (end < pairs_.size() && pairs_[end].point == pairs_[first].point &&
         other_of(pairs_[end]) == other_of(pairs_[first])) {
    ++end;
  }
  return end;
}

SkinContact::Stance SkinContact::nearest_stance(std::size_t first, std::size_t end, double depth) const {
  Stance nearest;
  for (std::size_t i = first; i < end; ++i) {
    Stance stance;
    if (!stand(pairs_[i], depth, stance)) continue;
    if (nearest.pair == nullptr || std::abs(stance.gap) < std::abs(nearest.gap)) nearest = stance;
  }
  return nearest;
}

void SkinContact::keep_hardest(const World& world, double dt, Stance stance) {
  const Watched& point = watched_[static_cast<std::size_t>(stance.pair->point)];
  Vec3 velocity = point.velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    velocity -= stance.weights[static_cast<Eigen::Index>(i)] *
                watched_[static_cast<std::size_t>(stance.pair->corners[i])].velocity;
  }
  const double speed = stance.normal.dot(velocity);
  if (!(stance.gap + dt * speed <= 0)) return;
  stance.least_speed = least_speed(stance.gap, world.gravity.norm(), dt);
  stance.pull = stance.least_speed - speed;
  const ContactPoint& at = skins_[point.actor].points[static_cast<std::size_t>(point.point)];
  const std::uint64_t key =
      touch_key(world.obstacles.size() + other_of(*stance.pair), point.actor, at.brick, at.corner);
  const auto [same, is_new] = hardest_.try_emplace(key, stance);
  if (!is_new && stance.pull > same->second.pull) same->second = stance;
}

void SkinContact::find(const World& world, double dt, const Group& group, Touches& touches) {
  const bool has_any =
      (world.bodies_touch && group.size() > 1) ||
      std::any_of(group.begin(), group.end(), [](const Actor* actor) { return actor->touches_itself; });
  if (!has_any) return;
  if (steps_to_look_ == 0) look(world, dt, group);
  --steps_to_look_;
  follow(group);
  const double depth = kDeepest * smallest_brick(group);
  hardest_.clear();
  for (std::size_t first = 0; first < pairs_.size();) {
    const std::size_t end = end_of_run(first);
    const Stance nearest = nearest_stance(first, end, depth);
    if (nearest.pair != nullptr) keep_hardest(world, dt, nearest);
    first = end;
  }
  for (const auto& [key, stance] : hardest_) add(group, stance, key, touches);
}

}  // namespace sprung
