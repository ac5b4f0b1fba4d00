#include "core/world/contact_groups.h"

#include <cmath>
#include <map>

#include "core/body/forces.h"
#include "core/disjoint_sets.h"
#include "core/world/near_boxes.h"

namespace sprung {
namespace {

/// All that a body can reach, m: it is carried along as a whole, and its nodes move about in it.
AlignedBox reach_of(const Body& body, const Vec3& gravity, double time) {
  const Vec3 mean = linear_momentum(body) / body.masses.sum();
  const double about = std::sqrt((body.velocities.rowwise() - mean.transpose()).rowwise().squaredNorm().maxCoeff());
  const Vec3 low = body.positions.colwise().minCoeff();
  const Vec3 high = body.positions.colwise().maxCoeff();
  AlignedBox reach(low, high);
  for (const Vec3& way : {Vec3(mean * time), Vec3((mean + gravity * time) * time)}) {
    reach.extend(low + way);
    reach.extend(high + way);
  }
  const Vec3 around = Vec3::Constant(about * time + body.grid.brick_size / 2);
  return {reach.min() - around, reach.max() + around};
}

}  // namespace

std::vector<std::vector<std::size_t>> contact_groups(const World& world, double time) {
  const auto count = world.actors.size();
  DisjointSets sets(count);
  if (world.bodies_touch && count > 1) {
    std::vector<AlignedBox> boxes;
    for (const Actor& actor : world.actors) boxes.push_back(reach_of(actor.body, world.gravity, time));
    for (const auto& [a, b] : overlapping_boxes(boxes)) sets.merge(a, b);
  }
  for (const GluedPoint& point : world.glue) {
    sets.merge(static_cast<int>(point.actors[0]), static_cast<int>(point.actors[1]));
  }
  std::map<int, std::vector<std::size_t>> members;  // by the lowest
  for (std::size_t i = 0; i < count; ++i) members[sets.find(static_cast<int>(i))].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(members.size());
  for (auto& [first, group] : members) groups.push_back(std::move(group));
  return groups;
}

}  // namespace sprung
