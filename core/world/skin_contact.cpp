#include "core/world/skin_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprung {
namespace {

constexpr double kMargin = 0.3;   // bricks: what is nearer than that is watched
constexpr double kDeepest = 0.7;  // bricks: what is deeper came from the other side
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

void SkinContact::add_shares(const Group& group, const WatchedPoint& watched, double weight, Touches& touches) const {
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
  const WatchedPoint& point = pairs_.watched(stance.pair->point);
  const WatchedPoint& corner = pairs_.watched(stance.pair->corners[0]);
  add_shares(group, point, 1, touches);
  for (std::size_t i = 0; i < 3; ++i) {
    add_shares(group, pairs_.watched(stance.pair->corners[i]), -stance.weights[static_cast<Eigen::Index>(i)], touches);
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

std::size_t SkinContact::other_of(const SkinPair& pair) const { return pairs_.watched(pair.corners[0]).actor; }

std::size_t SkinContact::end_of_run(std::size_t first) const {
  const std::vector<SkinPair>& pairs = pairs_.pairs();
  std::size_t end = first + 1;
  while (end < pairs.size() && pairs[end].point == pairs[first].point &&
         other_of(pairs[end]) == other_of(pairs[first])) {
    ++end;
  }
  return end;
}

SkinContact::Stance SkinContact::nearest_stance(std::size_t first, std::size_t end, double depth) const {
  Stance nearest;
  for (std::size_t i = first; i < end; ++i) {
    Stance stance;
    if (!stand(pairs_.pairs()[i], depth, stance)) continue;
    if (nearest.pair == nullptr || std::abs(stance.gap) < std::abs(nearest.gap)) nearest = stance;
  }
  return nearest;
}

void SkinContact::keep_hardest(const World& world, double dt, Stance stance) {
  const WatchedPoint& point = pairs_.watched(stance.pair->point);
  Vec3 velocity = point.velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    velocity -= stance.weights[static_cast<Eigen::Index>(i)] * pairs_.watched(stance.pair->corners[i]).velocity;
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
  const Group watched = self_ ? Group{group[*self_]} : group;
  const double brick = smallest_brick(watched);
  const double depth = kDeepest * brick;
  if (steps_to_look_ == 0) {
    steps_to_look_ = steps_until_look(kMargin * brick, fastest(watched), dt);
    pairs_.look(group, {.margin = kMargin * brick, .deepest = depth});
  }
  --steps_to_look_;
  pairs_.follow(group);
  hardest_.clear();
  for (std::size_t first = 0; first < pairs_.pairs().size();) {
    const std::size_t end = end_of_run(first);
    const Stance nearest = nearest_stance(first, end, depth);
    if (nearest.pair != nullptr) keep_hardest(world, dt, nearest);
    first = end;
  }
  for (const auto& [key, stance] : hardest_) add(group, stance, key, touches);
}

}  // namespace sprung
