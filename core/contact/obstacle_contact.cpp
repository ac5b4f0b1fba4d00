#include "core/contact/obstacle_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/body.h"
#include "core/body/forces.h"

namespace sprung {
namespace {

constexpr double kCornerFirst = 0.25;  // of points about as deep the one nearest to the corner holds the others best
constexpr double kMargin = 0.3;        // bricks: what is nearer than that is watched
constexpr double kCurved = 0.1;        // bricks that a surface may bend away from flat across a brick
constexpr double kFlat = 0.02;         // bricks that a point may move before the surface under it is asked for anew
constexpr double kLeftIn = 0.03;       // bricks that a point may lie inside while another holds it
constexpr int kPointsACorner = 2;      // of a brick, the nearest: others are held by them or found when next looked
constexpr double kOutside = 1.5;       // embedded points lie in the hull of the corners, or a little outside it where
                                       // the surface has no brick

/// Around its middle (m), of what rides in a brick.
double reach_of(const BrickColumns& x, const Vec3& middle) {
  return kOutside * std::sqrt((x.colwise() - middle).colwise().squaredNorm().maxCoeff());
}

}  // namespace

void ObstacleContact::look_at_brick(const Shape& shape, const Pose& pose, const Body& body, std::size_t at, Near near) {
  const ContactSurface& skin = *skins_[near.actor];
  const double margin = kMargin * body.grid.brick_size;
  near.brick = skin.bricks[at];
  const BrickColumns x = columns_of(body.grid.nodes[near.brick], body.positions);
  const Vec3 middle = x.rowwise().mean();
  const double far = reach_of(x, middle) + margin;
  const auto in_frame = [&](const Vec3& place) -> Vec3 {
    return pose.rotation.transpose() * (place - pose.translation);
  };
  Asked& asked = middles_[near.obstacle][near.actor][at];
  const Vec3 here = in_frame(middle);
  if (asked.least(here) > far) return;
  asked = {here, signed_distance(shape, {}, here)};
  if (asked.gap.distance > far) return;
  // Which points are nearest, and about how near, is told as if the surface were flat across a brick.
  std::vector<NearPoint> nearest;
  for (int i = skin.first_point[at]; i < skin.first_point[at + 1]; ++i) {
    const ContactPoint& point = skin.points[i];
    const Vec3 place = in_frame(x * point.weights);
    const double gap = asked.gap.distance + asked.gap.normal.dot(place - here) - kCurved * body.grid.brick_size;
    nearest.push_back({&point, {place, {gap, asked.gap.normal}}});
  }
  std::stable_sort(nearest.begin(), nearest.end(),
                   [](const NearPoint& a, const NearPoint& b) { return a.asked.gap.distance < b.asked.gap.distance; });
  near.first = points_.size();
  std::array<int, 8> kept{};
  for (const NearPoint& one : nearest) {
    if (one.asked.gap.distance > margin) break;
    if (kept[one.point->corner]++ < kPointsACorner) points_.push_back(one);
  }
  near.last = points_.size();
  if (near.last > near.first) near_.push_back(near);
}

Gap ObstacleContact::gap_now(const Shape& shape, double brick_size, const Vec3& place, NearPoint& near) {
  const Vec3 moved = place - near.asked.place;
  if (near.is_exact && moved.norm() <= kFlat * brick_size) {
    return {near.asked.gap.distance + near.asked.gap.normal.dot(moved), near.asked.gap.normal};
  }
  near.asked = {place, signed_distance(shape, {}, place)};
  near.is_exact = true;
  return near.asked.gap;
}

void ObstacleContact::look(const World& world, const std::vector<Pose>& poses, double dt, const Group& group) {
  near_.clear();
  points_.clear();
  int steps = steps_until_update(1, 0, 0, dt);
  for (std::size_t o = 0; o < poses.size(); ++o) {
    const Obstacle& obstacle = world.obstacles[o];
    for (std::size_t actor = 0; actor < group.size(); ++actor) {
      const Body& body = *group[actor];
      const Vec3 middle = body.positions.colwise().mean();
      const double around =
          std::sqrt((body.positions.rowwise() - middle.transpose()).rowwise().squaredNorm().maxCoeff());
      const double speed =
          largest_speed(body) + velocity_at(obstacle, poses[o], middle).norm() + obstacle.spin.norm() * around;
      steps = std::min(steps, steps_until_update(kMargin * body.grid.brick_size, speed, world.gravity.norm(), dt));
      for (std::size_t place = 0; place < skins_[actor]->bricks.size(); ++place) {
        look_at_brick(obstacle.shape, poses[o], body, place, {o, actor, 0, 0, 0});
      }
    }
  }
  steps_to_update_ = steps;
}

bool ObstacleContact::has_to_be_held(const BrickMotion& motion, const Hold& hold, NearPoint& near, Held& held) {
  const ContactPoint& point = *near.point;
  const Vec3 place = motion.x * point.weights;
  const Vec3 carried = velocity_at(hold.obstacle, hold.pose, place);
  const Vec3 velocity = motion.v * point.weights - carried;
  const Vec3 there = hold.pose.rotation.transpose() * (place - hold.pose.translation);
  if (near.asked.least(there) > hold.dt * velocity.norm()) return false;
  Gap gap = gap_now(hold.obstacle.shape, motion.brick_size, there, near);
  gap.normal = hold.pose.rotation * gap.normal;
  const double speed = gap.normal.dot(velocity);
  if (!(gap.distance + hold.dt * speed <= 0)) return false;  // nor where a number is not finite
  double least = least_speed(gap.distance, hold.gravity, hold.dt);
  if (gap.distance <= 0 && hold.obstacle.restitution > 0) least = std::max(least, -hold.obstacle.restitution * speed);
  held = {.point = &point,
          .pull = (least - speed) * (1 + kCornerFirst * point.weights[point.corner]),
          .gap = gap.distance,
          .normal = gap.normal,
          .goal = carried + least * gap.normal};
  return true;
}

void ObstacleContact::touch_brick(const World& world, const std::vector<Pose>& poses, double dt, const Group& group,
                                  const Near& near, ContactList& touches) {
  const Body& body = *group[near.actor];
  const auto& nodes = body.grid.nodes[near.brick];
  const Obstacle& obstacle = world.obstacles[near.obstacle];
  const Hold hold{obstacle, poses[near.obstacle], world.gravity.norm(), dt};
  const BrickMotion motion{columns_of(nodes, body.positions), columns_of(nodes, body.velocities), body.grid.brick_size};
  const auto add = [&](const Held& held, std::uint64_t rank) {
    const std::size_t first = touches.shares.size();
    for (std::size_t corner = 0; corner < 8; ++corner) {
      touches.shares.push_back({int(near.actor), nodes[corner], held.point->weights[corner]});
    }
    touches.list.push_back({.key = touch_key(near.obstacle, near.actor, near.brick, held.point->corner) | rank << 63,
                            .first = first,
                            .last = touches.shares.size(),
                            .normal = held.normal,
                            .goal = held.goal,
                            .friction = hold.obstacle.friction});
  };
  std::array<Held, 8> deepest{};
  for (std::size_t i = near.first; i < near.last; ++i) {
    Held held;
    if (!has_to_be_held(motion, hold, points_[i], held)) continue;
    Held& found = deepest[held.point->corner];
    if (found.point == nullptr || held.pull > found.pull) std::swap(found, held);
    if (held.point != nullptr && held.gap < -kLeftIn * motion.brick_size) add(held, 1);
  }
  for (const Held& held : deepest) {
    if (held.point != nullptr) add(held, 0);
  }
}

void ObstacleContact::find(const World& world, const std::vector<Pose>& poses, double dt, const Group& group,
                           ContactList& touches) {
  if (middles_.empty()) {
    middles_.resize(poses.size());
    for (auto& by_actor : middles_) {
      for (const ContactSurface* skin : skins_) by_actor.emplace_back(skin->bricks.size());
    }
  }
  if (steps_to_update_ == 0) look(world, poses, dt, group);
  --steps_to_update_;
  for (const Near& near : near_) touch_brick(world, poses, dt, group, near, touches);
}

}  // namespace sprung
