#include "core/world/contact_groups.h"

#include <map>

#include "core/body/forces.h"
#include "core/disjoint_sets.h"
#include "core/world/near_boxes.h"

namespace sprung {
namespace {

constexpr double kFaster = 2;  // than now: what springs back

/// All that a body can reach, m.
AlignedBox reach_of(const Body& body, double gravity, double time) {
  const double speed = largest_speed(body);
  const double way = kFaster * (speed + gravity * time) * time + body.grid.brick_size;
  return {body.positions.colwise().minCoeff().transpose() - Vec3::Constant(way),
          body.positions.colwise().maxCoeff().transpose() + Vec3::Constant(way)};
}

}  // namespace

std::vector<std::vector<std::size_t>> contact_groups(const World& world, double time) {
  const auto count = world.actors.size();
  DisjointSets sets(count);
  if (world.bodies_touch && count > 1) {
    std::vector<AlignedBox> boxes;
    for (const Actor& actor : world.actors) boxes.push_back(reach_of(actor.body, world.gravity.norm(), time));
    for (const auto& [a, b] : overlapping_boxes(boxes)) sets.merge(a, b);
  }
  std::map<int, std::vector<std::size_t>> members;  // by the lowest
  for (std::size_t i = 0; i < count; ++i) members[sets.find(static_cast<int>(i))].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(members.size());
  for (auto& [first, group] : members) groups.push_back(std::move(group));
  return groups;
}

}  // namespace sprung
