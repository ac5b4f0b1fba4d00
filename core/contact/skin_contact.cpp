#include "core/contact/skin_contact.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/body/body.h"
#include "core/contact/broad_phase.h"
#include "core/mesh/query/winding_tree.h"

namespace sprung {
namespace {

constexpr double kSkinMargin = 0.3;         // bricks: what is nearer than that is tracked
constexpr double kFarMargin = 1;            // bricks: what may soon be that near is checked
constexpr double kSkinDeepest = 0.7;        // bricks: what is deeper came from the other side
constexpr double kSuspicious = 0.1;         // bricks: what is deeper may be outside, beyond a part thinner than that
constexpr double kSuspiciousBeside = 0.01;  // likewise if it is beside the triangle
constexpr double kBarelyBeside = 1e-3;      // of a triangle: what is further beside it may be outside too
constexpr double kNotInside = 0.05;  // winding number of a closed surface up to which a point is outside, not on it
constexpr double kPressed = 0.4;     // of its volume, that a brick keeps: its points are not pushed out of any skin ...
constexpr double kSkinFlat = 0.15;   // ... nor supported by that of its own body

}  // namespace

SkinContact::SkinContact(const std::vector<const ContactSurface*>& skins, const Group& group, std::size_t body,
                         std::size_t other)
    : skins_(skins),
      bodies_{body, other},
      pairs_(skins, body, other),
      brick_(std::min(group[body]->grid.brick_size, group[other]->grid.brick_size)) {}

void SkinContact::add_front(SurfaceTree& tree, SurfaceTree& other_tree) {
  facing_.emplace(tree, other_tree, kSkinDeepest * brick_);
  front_.emplace(tree, other_tree, kSkinMargin * brick_, *facing_);
}

void SkinContact::add(const Group& group, const ActiveContact& active, ContactList& contacts) const {
  const std::size_t first = contacts.shares.size();
  const PointTriangleContact& stance = active.stance;
  const TrackedPoint& point = pairs_.tracked(stance.pair->point);
  const ContactPoint& at = skins_[point.body]->points[point.point];
  add_shares(group, point.body, at.brick, at.weights, contacts);
  const std::size_t other = other_of(pairs_, *stance.pair);
  const TriangleStencil stencil = contact_stencil(pairs_, *skins_[other], stance);
  for (std::size_t i = 0; i < stencil.count; ++i)
    add_shares(group, other, stencil.bricks[i], stencil.weights[i], contacts);
  const double other_friction = group[other]->contact.friction;
  contacts.list.push_back({.key = active.key,
                           .first = first,
                           .last = contacts.shares.size(),
                           .normal = stance.normal,
                           .goal = active.min_speed * stance.normal,
                           .friction = std::sqrt(group[point.body]->contact.friction * other_friction)});
}

/// If pushed out of each other, skins of bricks that have no room left would press those flat, and for ever: the guard
/// against that pushes back, and each gives energy to the other. They are kept from going deeper, no more; and where
/// not even that can be had, a body had rather lie in itself than turn inside out.
double SkinContact::volume_ratio_of(const Group& group, const CandidatePair& pair) const {
  const auto of = [&](int row) {
    const TrackedPoint& point = pairs_.tracked(row);
    const Body& body = *group[point.body];
    const int brick = skins_[point.body]->points[point.point].brick;
    const Mat3 axes = mean_axes_of(columns_of(body.grid.nodes[brick], body.positions));
    return axes.determinant() / body.grid.brick_volume();
  };
  double least = of(pair.point);
  for (const int corner : pair.corners) least = std::min(least, of(corner));
  return least;
}

bool SkinContact::is_active(const World& world, double dt, const Group& group, ActiveContact& active) const {
  const PointTriangleContact& stance = active.stance;
  const TrackedPoint& point = pairs_.tracked(stance.pair->point);
  Vec3 velocity = point.velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    velocity -= stance.weights[i] * pairs_.tracked(stance.pair->corners[i]).velocity;
  }
  const double speed = stance.normal.dot(velocity);
  if (!(stance.gap + dt * speed <= 0)) return false;
  const double room = stance.gap >= 0 ? 1 : volume_ratio_of(group, *stance.pair);
  if (room < kSkinFlat && bodies_[0] == bodies_[1]) return false;
  active.min_speed = room > kPressed ? min_speed(stance.gap, world.gravity.norm(), dt) : 0;
  active.urgency = active.min_speed - speed;
  const ContactPoint& at = skins_[point.body]->points[point.point];
  active.key = contact_key(world.obstacles.size() + other_of(pairs_, *stance.pair), point.body, at.brick, at.corner);
  return true;
}

bool SkinContact::find_inside(const Group& group, const PointTriangleContact& stance) const {
  const std::size_t other = other_of(pairs_, *stance.pair);
  const TrackedPoint& point = pairs_.tracked(stance.pair->point);
  // A point of the surface itself is tested from just outside.
  const double off = point.body == other ? kSuspicious / 2 * group[other]->grid.brick_size : 0;
  const Vec3 position = point.position + off * point.normal;
  const ContactSurface& surface = *skins_[other];
  std::vector<Vec3> positions;
  for (const ContactPoint& at : surface.points)
    positions.push_back(carried(*group[other], at, group[other]->positions));
  double angle = 0;
  for (const auto& [a, b, c] : surface.triangles)
    angle += solid_angle(positions[a], positions[b], positions[c], position);
  return angle > kNotInside * 4 * std::numbers::pi;
}

bool SkinContact::is_inside(const Group& group, const PointTriangleContact& stance) {
  const TrackedPoint& point = pairs_.tracked(stance.pair->point);
  const std::tuple key(point.body, point.point, other_of(pairs_, *stance.pair));
  const auto before = insides_before_.find(key);
  return insides_.try_emplace(key, before != insides_before_.end() ? before->second : find_inside(group, stance))
      .first->second;
}

void SkinContact::keep_largest_correction() {
  std::stable_sort(active_.begin(), active_.end(), [](const ActiveContact& a, const ActiveContact& b) {
    return std::pair(a.key, -a.urgency) < std::pair(b.key, -b.urgency);
  });
  const auto end = std::unique(active_.begin(), active_.end(),
                               [](const ActiveContact& a, const ActiveContact& b) { return a.key == b.key; });
  active_.erase(end, active_.end());
}

void SkinContact::look(const Group& group) {
  if (!front_->advance()) return pairs_.turn(group);
  pairs_.take(group, facing_->lists());
  runs_ = runs_of(pairs_);
}

void SkinContact::look_in_time(const Group& group, double gravity, double dt) {
  if (to_update_.is_due()) {
    if (to_seek_.is_due()) {
      pairs_.seek(group, kFarMargin * brick_);
      to_seek_.restart(steps_until_update((kFarMargin - kSkinMargin) * brick_, pairs_.fastest(group), gravity, dt));
    }
    pairs_.look(group, {.margin = kSkinMargin * brick_, .deepest = kSkinDeepest * brick_});
    runs_ = runs_of(pairs_);
    to_update_ = to_seek_;
    if (pairs_.has_near_bricks()) {
      const int steps = steps_until_update(pairs_.nearest_beyond(), pairs_.fastest_near(group), gravity, dt);
      to_update_.restart(std::min(steps, to_seek_.steps()));
    }
  }
  to_seek_.tick();
  to_update_.tick();
}

void SkinContact::find(const World& world, double dt, const Group& group, ContactList& contacts) {
  if (!front_) look_in_time(group, world.gravity.norm(), dt);
  pairs_.follow(group);
  active_.clear();
  std::swap(insides_, insides_before_);
  insides_.clear();
  const double depth = kSkinDeepest * brick_;
  for (SkinRun& run : runs_) {
    ActiveContact nearest{.stance = closest_triangle(pairs_, run, depth)};
    if (nearest.stance.pair == nullptr) continue;
    const bool is_beside = nearest.stance.weights.minCoeff() < -kBarelyBeside;
    const double suspicious = is_beside ? kSuspiciousBeside : kSuspicious;
    if (nearest.stance.gap < -suspicious * brick_ && !is_inside(group, nearest.stance)) continue;
    if (is_active(world, dt, group, nearest)) active_.push_back(nearest);
  }
  keep_largest_correction();
  for (const ActiveContact& active : active_) add(group, active, contacts);
}

namespace {

constexpr double kLookAhead = 0.1;  // bricks that bodies may move until contacts are searched for again
constexpr int kMaxStepsAhead = 8;   // until then
constexpr double kFaster = 1.5;     // times, that speeds may grow until then
constexpr double kBodyMargin = 2;   // bricks: bodies nearer than that are tracked

/// The largest speed of any node, m/s, relative to the rigid motion of all.
double fastest(const Group& group) {
  const RigidMotion rigid = rigid_motion_of(group);
  double most = 0;
  for (const SoftBody* body : group) {
    for (int node = 0; node < body->node_count(); ++node) {
      const Vec3 velocity = body->velocities.row(node);
      most = std::max(most, (velocity - rigid.at(body->positions.row(node))).squaredNorm());
    }
  }
  return std::sqrt(most);
}

}  // namespace

SkinContacts::SkinContacts(const Group& group, ContactSearch search) : group_(group) {
  for (SoftBody* body : group) {
    skins_.push_back(&contact_surface_of(*body));
    if (search == ContactSearch::kFronts) trees_.push_back(std::make_unique<SurfaceTree>(*skins_.back(), *body));
  }
}

bool SkinContacts::is_of(const Group& group) const {
  if (group != group_) return false;
  for (std::size_t body = 0; body < group.size(); ++body) {
    if (group[body]->contact.surface.get() != skins_[body]) return false;
  }
  return true;
}

void SkinContacts::begin_frame() {
  contacts_.clear();
  to_seek_ = {};
  to_look_ = {};
}

void SkinContacts::seek(const World& world, const Group& group, double dt) {
  const double margin = kBodyMargin * smallest_brick(group);
  to_seek_.restart(steps_until_update(margin, fastest(group), world.gravity.norm(), dt));
  std::map<std::pair<std::size_t, std::size_t>, SkinContact> contacts;
  for (const auto& pair : broad_phase(world, group, margin)) {
    if (auto known = contacts_.extract(pair)) {
      contacts.insert(std::move(known));
    } else {
      SkinContact& contact = contacts.try_emplace(pair, skins_, group, pair.first, pair.second).first->second;
      if (!trees_.empty()) contact.add_front(*trees_[pair.first], *trees_[pair.second]);
    }
  }
  contacts_ = std::move(contacts);
  to_look_ = {};
}

void SkinContacts::look(const std::vector<SkinContact*>& contacts, double gravity, double dt) {
  double fastest = 0;
  for (const auto& tree : trees_) fastest = std::max(fastest, tree->fastest());
  const double way = kLookAhead * smallest_brick(group_);
  const bool is_slow = 2 * fastest * dt * kMaxStepsAhead <= way;
  to_look_.restart(is_slow ? kMaxStepsAhead : std::max(1, int(way / (2 * fastest * dt))));
  const double time = to_look_.steps() * dt;
  const auto follow = [&](std::size_t body) { trees_[body]->follow(kFaster * time, gravity * time * time); };
  tbb::parallel_for(std::size_t{0}, trees_.size(), follow);
  for (SkinContact* contact : contacts) contact->look(group_);
}

void SkinContacts::find(const World& world, double dt, const Group& group, ContactList& found) {
  if (to_seek_.is_due()) seek(world, group, dt);
  to_seek_.tick();
  std::vector<SkinContact*> contacts;
  contacts.reserve(contacts_.size());
  for (auto& [pair, contact] : contacts_) contacts.push_back(&contact);
  if (contacts.empty()) return;
  if (!trees_.empty() && to_look_.is_due()) look(contacts, world.gravity.norm(), dt);
  to_look_.tick();
  found_.resize(contacts.size());
  tbb::parallel_for(std::size_t{0}, contacts.size(), [&](std::size_t i) {
    found_[i].clear();
    contacts[i]->find(world, dt, group, found_[i]);
  });
  for (const ContactList& list : found_) found.append(list);
}

}  // namespace sprung
