#include "core/contact/obstacle_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/body.h"
#include "core/body/forces.h"

namespace sprung {
namespace {

constexpr double kCornerFirst = 0.25;  // of points about as deep, the one nearest the corner supports the others best
constexpr double kMargin = 0.3;        // bricks: points nearer than that are tracked
constexpr double kCurved = 0.1;        // bricks that a surface may deviate from flat across a brick
constexpr double kFlat = 0.02;         // bricks that a point may move before the surface under it is queried again
constexpr double kLeftIn = 0.03;       // bricks that a point may lie inside while another supports it
constexpr int kPointsACorner = 2;      // of a brick, the nearest: they support the others, or these are found next time
constexpr double kOutside = 1.5;       // embedded points lie in the hull of the corners, or a little outside it where
                                       // the surface has no brick

/// About its middle (m), of points embedded in a brick.
double reach_of(const BrickColumns& x, const Vec3& middle) {
  return kOutside * std::sqrt((x.colwise() - middle).colwise().squaredNorm().maxCoeff());
}

}  // namespace

void ObstacleContact::look_at_brick(const Shape& shape, const Pose& pose, const Body& body, std::size_t at, Near near) {
  const ContactSurface& skin = *skins_[near.body];
  const double margin = kMargin * body.grid.brick_size;
  near.brick = skin.bricks[at];
  const BrickColumns x = columns_of(body.grid.nodes[near.brick], body.positions);
  const Vec3 middle = x.rowwise().mean();
  const double far = reach_of(x, middle) + margin;
  const auto in_frame = [&](const Vec3& position) -> Vec3 {
    return pose.rotation.transpose() * (position - pose.translation);
  };
  GapQuery& query = middles_[near.obstacle][near.body][at];
  const Vec3 here = in_frame(middle);
  if (query.lower_bound(here) > far) return;
  query = {here, signed_distance(shape, {}, here)};
  if (query.gap.distance > far) return;
  // Which points are nearest, and about how near, is estimated as if the surface were flat across a brick.
  std::vector<NearPoint> nearest;
  for (int i = skin.first_point[at]; i < skin.first_point[at + 1]; ++i) {
    const ContactPoint& point = skin.points[i];
    const Vec3 position = in_frame(x * point.weights);
    const double gap = query.gap.distance + query.gap.normal.dot(position - here) - kCurved * body.grid.brick_size;
    nearest.push_back({&point, {position, {gap, query.gap.normal}}});
  }
  std::stable_sort(nearest.begin(), nearest.end(),
                   [](const NearPoint& a, const NearPoint& b) { return a.query.gap.distance < b.query.gap.distance; });
  near.first = points_.size();
  std::array<int, 8> kept{};
  for (const NearPoint& one : nearest) {
    if (one.query.gap.distance > margin) break;
    if (kept[one.point->corner]++ < kPointsACorner) points_.push_back(one);
  }
  near.last = points_.size();
  if (near.last > near.first) near_.push_back(near);
}

Gap ObstacleContact::gap_now(const Shape& shape, double brick_size, const Vec3& position, NearPoint& near) {
  const Vec3 moved = position - near.query.position;
  if (near.is_exact && moved.norm() <= kFlat * brick_size) {
    return {near.query.gap.distance + near.query.gap.normal.dot(moved), near.query.gap.normal};
  }
  near.query = {position, signed_distance(shape, {}, position)};
  near.is_exact = true;
  return near.query.gap;
}

void ObstacleContact::look(const World& world, const std::vector<Pose>& poses, double dt, const Group& group) {
  near_.clear();
  points_.clear();
  int steps = steps_until_update(1, 0, 0, dt);
  for (std::size_t o = 0; o < poses.size(); ++o) {
    const Obstacle& obstacle = world.obstacles[o];
    for (std::size_t b = 0; b < group.size(); ++b) {
      const Body& body = *group[b];
      const Vec3 middle = body.positions.colwise().mean();
      const double around =
          std::sqrt((body.positions.rowwise() - middle.transpose()).rowwise().squaredNorm().maxCoeff());
      const double speed =
          largest_speed(body) + velocity_at(obstacle, poses[o], middle).norm() + obstacle.spin.norm() * around;
      steps = std::min(steps, steps_until_update(kMargin * body.grid.brick_size, speed, world.gravity.norm(), dt));
      for (std::size_t index = 0; index < skins_[b]->bricks.size(); ++index) {
        look_at_brick(obstacle.shape, poses[o], body, index, {o, b, 0, 0, 0});
      }
    }
  }
  to_look_.restart(steps);
}

bool ObstacleContact::is_active(const BrickMotion& motion, const ObstacleState& state, NearPoint& near,
                                ActiveContact& active) {
  const ContactPoint& point = *near.point;
  const Vec3 position = motion.x * point.weights;
  const Vec3 carried = velocity_at(state.obstacle, state.pose, position);
  const Vec3 velocity = motion.v * point.weights - carried;
  const Vec3 there = state.pose.rotation.transpose() * (position - state.pose.translation);
  if (near.query.lower_bound(there) > state.dt * velocity.norm()) return false;
  Gap gap = gap_now(state.obstacle.shape, motion.brick_size, there, near);
  gap.normal = state.pose.rotation * gap.normal;
  const double speed = gap.normal.dot(velocity);
  if (!(gap.distance + state.dt * speed <= 0)) return false;  // nor if a number is not finite
  double least = min_speed(gap.distance, state.gravity, state.dt);
  if (gap.distance <= 0 && state.obstacle.restitution > 0) least = std::max(least, -state.obstacle.restitution * speed);
  active = {.point = &point,
            .urgency = (least - speed) * (1 + kCornerFirst * point.weights[point.corner]),
            .gap = gap.distance,
            .normal = gap.normal,
            .goal = carried + least * gap.normal};
  return true;
}

void ObstacleContact::touch_brick(const World& world, const std::vector<Pose>& poses, double dt, const Group& group,
                                  const Near& near, ContactList& contacts) {
  const Body& body = *group[near.body];
  const auto& nodes = body.grid.nodes[near.brick];
  const Obstacle& obstacle = world.obstacles[near.obstacle];
  const ObstacleState state{obstacle, poses[near.obstacle], world.gravity.norm(), dt};
  const BrickMotion motion{columns_of(nodes, body.positions), columns_of(nodes, body.velocities), body.grid.brick_size};
  const auto add = [&](const ActiveContact& active, std::uint64_t rank) {
    const std::size_t first = contacts.shares.size();
    for (std::size_t corner = 0; corner < 8; ++corner) {
      contacts.shares.push_back({int(near.body), nodes[corner], active.point->weights[corner]});
    }
    contacts.list.push_back(
        {.key = contact_key(near.obstacle, near.body, near.brick, active.point->corner) | rank << 63,
         .first = first,
         .last = contacts.shares.size(),
         .normal = active.normal,
         .goal = active.goal,
         .friction = state.obstacle.friction});
  };
  std::array<ActiveContact, 8> deepest{};
  for (std::size_t i = near.first; i < near.last; ++i) {
    ActiveContact active;
    if (!is_active(motion, state, points_[i], active)) continue;
    ActiveContact& found = deepest[active.point->corner];
    if (found.point == nullptr || active.urgency > found.urgency) std::swap(found, active);
    if (active.point != nullptr && active.gap < -kLeftIn * motion.brick_size) add(active, 1);
  }
  for (const ActiveContact& active : deepest) {
    if (active.point != nullptr) add(active, 0);
  }
}

void ObstacleContact::find(const World& world, const std::vector<Pose>& poses, double dt, const Group& group,
                           ContactList& contacts) {
  if (middles_.empty()) {
    middles_.resize(poses.size());
    for (auto& by_body : middles_) {
      for (const ContactSurface* skin : skins_) by_body.emplace_back(skin->bricks.size());
    }
  }
  if (to_look_.is_due()) look(world, poses, dt, group);
  to_look_.tick();
  for (const Near& near : near_) touch_brick(world, poses, dt, group, near, contacts);
}

}  // namespace sprung
