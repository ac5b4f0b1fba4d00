#include "core/world/near_skins.h"

#include <algorithm>
#include <cmath>

#include "core/world/near_boxes.h"
#include "core/world/skin_pairs.h"

namespace sprung {
namespace {

constexpr double kFurthestMove = 0.5;  // of a brick

/// s, until something that moves at a speed and is accelerated by gravity has come that far.
double time_to_move(double way, double speed, double gravity, double most) {
  if (speed * most + gravity * most * most / 2 <= way) return most;
  return 2 * way / (speed + std::sqrt(speed * speed + 2 * gravity * way));
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> near_skins(const World& world, const Group& group, double margin) {
  std::vector<AlignedBox> boxes;
  std::vector<std::pair<std::size_t, std::size_t>> near;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Body& body = group[i]->body;
    boxes.push_back(
        widened(box_around(body.positions), margin + body.grid.brick_size));  // skins may lie outside bricks
    if (group[i]->touches_itself) near.emplace_back(i, i);
  }
  if (world.bodies_touch) {
    for (const auto& [a, b] : overlapping_boxes(boxes)) near.emplace_back(a, b);
  }
  return near;
}

double longest_stride(const World& world, const Group& group, double dt) {
  std::vector<const ContactSkin*> skins;
  for (Actor* actor : group) skins.push_back(&contact_skin_of(*actor));
  double fastest = 0;
  for (const Actor* actor : group) fastest = std::max(fastest, actor->body.velocities.rowwise().norm().maxCoeff());
  double stride = dt;
  for (const auto& [a, b] : near_skins(world, group, 2 * (fastest + world.gravity.norm() * dt) * dt)) {
    SkinPairs pairs(skins, a, b);
    const double brick = std::min(group[a]->body.grid.brick_size, group[b]->body.grid.brick_size);
    const double gravity = a == b ? 0 : world.gravity.norm();  // all of a body falls alike
    // Two that come from either side are twice as fast.
    pairs.seek(group, brick + 2 * pairs.fastest(group) * dt + gravity * dt * dt / 2);
    if (!pairs.has_near_bricks()) continue;
    stride = std::min(stride, time_to_move(kFurthestMove * brick, pairs.closing_speed(group, dt), gravity, dt));
  }
  return stride;
}

}  // namespace sprung
