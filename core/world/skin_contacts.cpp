#include "core/world/skin_contacts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/world/near_skins.h"

namespace sprung {
namespace {

constexpr double kMargin = 2;  // bricks: bodies nearer than that are watched

/// Of any node, m/s, seen from the rigid motion of all.
double fastest(const Group& group) {
  const RigidMotion rigid = rigid_motion_of(group);
  double most = 0;
  for (const Actor* actor : group) {
    const Body& body = actor->body;
    for (int node = 0; node < body.node_count(); ++node) {
      const Vec3 velocity = body.velocities.row(node);
      most = std::max(most, (velocity - rigid.at(body.positions.row(node))).squaredNorm());
    }
  }
  return std::sqrt(most);
}

}  // namespace

void SkinContacts::seek(const World& world, const Group& group, double dt) {
  const double margin = kMargin * smallest_brick(group);
  steps_to_seek_ = steps_until_look(margin, fastest(group), world.gravity.norm(), dt);
  std::map<std::pair<std::size_t, std::size_t>, SkinContact> contacts;
  for (const auto& pair : near_skins(world, group, margin)) {
    if (auto known = contacts_.extract(pair)) {
      contacts.insert(std::move(known));
    } else {
      contacts.try_emplace(pair, skins_, pair.first, pair.second);
    }
  }
  contacts_ = std::move(contacts);
}

void SkinContacts::find(const World& world, double dt, const Group& group, Touches& touches) {
  if (steps_to_seek_ == 0) seek(world, group, dt);
  --steps_to_seek_;
  std::vector<SkinContact*> contacts;
  contacts.reserve(contacts_.size());
  for (auto& [pair, contact] : contacts_) contacts.push_back(&contact);
  found_.resize(contacts.size());
  tbb::parallel_for(std::size_t{0}, contacts.size(), [&](std::size_t i) {
    found_[i].clear();
    contacts[i]->find(world, dt, group, found_[i]);
  });
  for (const Touches& found : found_) touches.append(found);
}

}  // namespace sprung
