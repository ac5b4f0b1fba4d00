#include "core/world/skin_contact.h"

#include <algorithm>
#include <cmath>

#include "core/body/brick_columns.h"

namespace sprung {
namespace {

constexpr double kMargin = 0.3;     // bricks: what is nearer than that is watched
constexpr double kFarMargin = 1;    // bricks: what may soon be that near is looked at
constexpr double kDeepest = 0.7;    // bricks: what is deeper came from the other side
constexpr double kBeside = 0.05;    // of a triangle: what stands a little beside it counts as over it
constexpr double kTouching = 0.15;  // of the depth: what is that near to a triangle that it stands over touches it
constexpr double kPressed = 0.4;    // of its volume, that a brick keeps: what it carries is pushed out of no skin

}  // namespace

bool SkinContact::stand(const SkinPair& pair, double depth, Stance& stance) const {
  const WatchedPoint& point = pairs_.watched(pair.point);
  std::array<const WatchedPoint*, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) corners[i] = &pairs_.watched(pair.corners[i]);
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

void SkinContact::add_triangle(const Group& group, const Stance& stance, Touches& touches) const {
  std::array<int, 3> bricks{};
  std::array<Eigen::Matrix<double, 8, 1>, 3> weights;
  std::size_t count = 0;
  const std::size_t actor = other_of(*stance.pair);
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = pairs_.watched(stance.pair->corners[i]).point;
    const ContactPoint& corner = skins_[actor]->points[static_cast<std::size_t>(row)];
    const auto same = static_cast<std::size_t>(
        std::find(bricks.begin(), bricks.begin() + static_cast<std::ptrdiff_t>(count), corner.brick) - bricks.begin());
    if (same == count) {
      bricks[count] = corner.brick;
      weights[count++].setZero();
    }
    weights[same] -= stance.weights[static_cast<Eigen::Index>(i)] * corner.weights;
  }
  for (std::size_t i = 0; i < count; ++i) add_shares(group, actor, bricks[i], weights[i], touches);
}

void SkinContact::add(const Group& group, const Stance& stance, Touches& touches) const {
  const std::size_t first = touches.shares.size();
  const WatchedPoint& point = pairs_.watched(stance.pair->point);
  const ContactPoint& at = skins_[point.actor]->points[static_cast<std::size_t>(point.point)];
  add_shares(group, point.actor, at.brick, at.weights, touches);
  add_triangle(group, stance, touches);
  const double other_friction = group[other_of(*stance.pair)]->friction;
  touches.list.push_back({.key = stance.key,
                          .first = first,
                          .last = touches.shares.size(),
                          .normal = stance.normal,
                          .goal = stance.least_speed * stance.normal,
                          .friction = std::sqrt(group[point.actor]->friction * other_friction)});
}

std::size_t SkinContact::other_of(const SkinPair& pair) const { return pairs_.watched(pair.corners[0]).actor; }

std::vector<SkinContact::Run> SkinContact::runs_of_pairs() const {
  const std::vector<SkinPair>& pairs = pairs_.pairs();
  std::vector<Run> runs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool goes_on = i > 0 && pairs[i].point == pairs[i - 1].point && other_of(pairs[i]) == other_of(pairs[i - 1]);
    if (!goes_on) runs.push_back({.first = i, .end = i, .last = i});
    runs.back().end = i + 1;
  }
  return runs;
}

SkinContact::Stance SkinContact::nearest_stance(Run& run, double depth) const {
  Stance nearest;
  const std::vector<SkinPair>& pairs = pairs_.pairs();
  if (stand(pairs[run.last], depth, nearest) && std::abs(nearest.gap) < kTouching * depth) return nearest;
  nearest.pair = nullptr;
  for (std::size_t i = run.first; i < run.end; ++i) {
    Stance stance;
    if (!stand(pairs[i], depth, stance)) continue;
    if (nearest.pair != nullptr && std::abs(stance.gap) >= std::abs(nearest.gap)) continue;
    nearest = stance;
    run.last = i;
  }
  return nearest;
}

/// Pushed out of each other, skins of bricks that have no room left would press those flat, and for ever: the guard
/// against that pushes back, and each gives energy to the other. They are kept from going deeper, no more.
bool SkinContact::has_room(const Group& group, const SkinPair& pair) const {
  const auto has = [&](int row) {
    const WatchedPoint& point = pairs_.watched(row);
    const Body& body = group[point.actor]->body;
    const int brick = skins_[point.actor]->points[static_cast<std::size_t>(point.point)].brick;
    const Mat3 axes = mean_axes_of(columns_of(body.grid.nodes[static_cast<std::size_t>(brick)], body.positions));
    return axes.determinant() > kPressed * body.grid.brick_volume();
  };
  return has(pair.point) && std::all_of(pair.corners.begin(), pair.corners.end(), has);
}

bool SkinContact::has_to_be_held(const World& world, double dt, const Group& group, Stance& stance) const {
  const WatchedPoint& point = pairs_.watched(stance.pair->point);
  Vec3 velocity = point.velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    velocity -= stance.weights[static_cast<Eigen::Index>(i)] * pairs_.watched(stance.pair->corners[i]).velocity;
  }
  const double speed = stance.normal.dot(velocity);
  if (!(stance.gap + dt * speed <= 0)) return false;
  const bool is_lifted = stance.gap >= 0 || has_room(group, *stance.pair);
  stance.least_speed = is_lifted ? least_speed(stance.gap, world.gravity.norm(), dt) : 0;
  stance.pull = stance.least_speed - speed;
  const ContactPoint& at = skins_[point.actor]->points[static_cast<std::size_t>(point.point)];
  stance.key = touch_key(world.obstacles.size() + other_of(*stance.pair), point.actor, at.brick, at.corner);
  return true;
}

void SkinContact::keep_hardest() {
  std::stable_sort(held_.begin(), held_.end(), [](const Stance& a, const Stance& b) {
    return std::pair(a.key, -a.pull) < std::pair(b.key, -b.pull);
  });
  const auto end =
      std::unique(held_.begin(), held_.end(), [](const Stance& a, const Stance& b) { return a.key == b.key; });
  held_.erase(end, held_.end());
}

void SkinContact::look(const Group& group, double gravity, double dt) {
  if (steps_to_look_ == 0) {
    const double brick = std::min(group[actors_[0]]->body.grid.brick_size, group[actors_[1]]->body.grid.brick_size);
    if (steps_to_seek_ <= 0) {
      pairs_.seek(group, kFarMargin * brick);
      steps_to_seek_ = steps_until_look((kFarMargin - kMargin) * brick, pairs_.fastest(group), gravity, dt);
    }
    depth_ = kDeepest * brick;
    pairs_.look(group, {.margin = kMargin * brick, .deepest = depth_});
    runs_ = runs_of_pairs();
    steps_to_look_ = steps_to_seek_;
    if (pairs_.has_near_bricks()) {
      const int steps = steps_until_look(pairs_.nearest_beyond(), pairs_.fastest_near(group), gravity, dt);
      steps_to_look_ = std::min(steps, steps_to_seek_);
    }
  }
  --steps_to_seek_;
  --steps_to_look_;
}

void SkinContact::find(const World& world, double dt, const Group& group, Touches& touches) {
  look(group, world.gravity.norm(), dt);
  pairs_.follow(group);
  held_.clear();
  for (Run& run : runs_) {
    Stance nearest = nearest_stance(run, depth_);
    if (nearest.pair != nullptr && has_to_be_held(world, dt, group, nearest)) held_.push_back(nearest);
  }
  keep_hardest();
  for (const Stance& stance : held_) add(group, stance, touches);
}

}  // namespace sprung
