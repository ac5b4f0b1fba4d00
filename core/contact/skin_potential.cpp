#include "core/contact/skin_potential.h"

#include <algorithm>
#include <cmath>

#include "core/contact/broad_phase.h"
#include "core/contact/contacts.h"
#include "core/contact/obstacle_potential.h"

namespace sprung {
namespace {

constexpr double kStepMargin = 1;   // bricks: what is nearer than that may touch within the step
constexpr double kStepDeepest = 1;  // bricks: what is deeper came from the other side

}  // namespace

SkinPotential::SkinPotential(const World& world, const Group& group, const std::vector<GluedPoint>& glue,
                             const Step& step, const std::vector<Eigen::VectorXd*>& penetrations)
    : group_(group), glue_(glue), slip_(step.slip) {
  for (SoftBody* body : group) {
    skins_.push_back(&contact_surface_of(*body));
    starts_.push_back(body->positions);
  }
  watch(world, penetrations);
  refresh();
  lift(world.gravity.norm(), step.dt);
  update_friction();
}

void SkinPotential::lift(double gravity, double dt) {
  for (Watch& watch : watches_) {
    if (watch.initial_penetration > 0)
      watch.initial_penetration -= dt * min_speed(-watch.initial_penetration, gravity, dt);
  }
}

void SkinPotential::watch(const World& world, const std::vector<Eigen::VectorXd*>& penetrations) {
  std::vector<std::vector<double>> stiffness(group_.size());
  double largest_brick = 0;
  for (const SoftBody* body : group_) largest_brick = std::max(largest_brick, body->grid.brick_size);
  for (const auto& [a, b] : broad_phase(world, group_, kStepMargin * largest_brick)) {
    const double brick = std::min(group_[a]->grid.brick_size, group_[b]->grid.brick_size);
    ContactCandidates& pairs = pairs_.emplace_back(skins_, a, b);
    pairs.seek(group_, kStepMargin * brick);
    pairs.look(group_, {.margin = kStepMargin * brick, .deepest = kStepDeepest * brick});
    for (const SkinRun& run : runs_of(pairs)) {
      const CandidatePair& pair = pairs.pairs()[run.first];
      const TrackedPoint& point = pairs.tracked(pair.point);
      std::vector<double>& own = stiffness[point.body];
      if (own.empty()) own = contact_stiffness(*group_[point.body], *skins_[point.body]);
      watches_.push_back({.pairs = &pairs,
                          .run = run,
                          .depth = kStepDeepest * brick,
                          .stiffness = own[point.point],
                          .friction = std::sqrt(group_[point.body]->contact.friction *
                                                group_[other_of(pairs, pair)]->contact.friction),
                          .penetrations = (*penetrations[point.body])[point.point]});
    }
  }
}

void SkinPotential::refresh() {
  if (!contacts_.empty()) {
    for (Watch& watch : watches_) watch.penetrations = 0;
  }
  for (const ActiveContact& active : contacts_) {
    if (!active.is_glue) watches_[active.watch].penetrations = depth(active, sum(active.coupling, false));
  }
  contacts_.clear();
  add_glue();
  for (ContactCandidates& pairs : pairs_) pairs.follow(group_);
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    Watch& watch = watches_[i];
    const PointTriangleContact stance = closest_triangle(*watch.pairs, watch.run, watch.depth);
    if (stance.pair != watch.pair) watch.initial_penetration = std::max(0.0, -stance.gap - watch.penetrations);
    watch.pair = stance.pair;
    if (stance.pair != nullptr) add_contact(i, stance);
  }
}

void SkinPotential::add_glue() {
  for (const GluedPoint& point : glue_) {
    Coupling coupling;
    for (std::size_t side = 0; side < 2; ++side) {
      coupling.corners.push_back({.body = point.bodies[side],
                                  .brick = point.bricks[side],
                                  .weights = (side == 0 ? 1 : -1) * point.weights[side]});
    }
    const double stiffness =
        glue_stiffness(*group_[point.bodies[0]], point.bricks[0], *group_[point.bodies[1]], point.bricks[1]);
    contacts_.push_back({.watch = 0,
                         .is_glue = true,
                         .coupling = std::move(coupling),
                         .stiffness = stiffness,
                         .normal = Vec3::Zero(),
                         .start = Vec3::Zero()});
  }
}

void SkinPotential::add_contact(std::size_t watch, const PointTriangleContact& stance) {
  const ContactCandidates& pairs = *watches_[watch].pairs;
  const TrackedPoint& point = pairs.tracked(stance.pair->point);
  const ContactPoint& at = skins_[point.body]->points[point.point];
  const std::size_t other = other_of(pairs, *stance.pair);
  const TriangleStencil stencil = contact_stencil(pairs, *skins_[other], stance);
  Coupling coupling;
  coupling.corners.push_back({.body = point.body, .brick = at.brick, .weights = at.weights});
  for (std::size_t i = 0; i < stencil.count; ++i) {
    coupling.corners.push_back({.body = other, .brick = stencil.bricks[i], .weights = stencil.weights[i]});
  }
  const double stiffness =
      pair_stiffness(watches_[watch].stiffness, *group_[point.body], at.brick, *group_[other], stencil.bricks[0]);
  const Vec3 start = sum(coupling, true);
  contacts_.push_back({.watch = watch,
                       .is_glue = false,
                       .coupling = std::move(coupling),
                       .stiffness = stiffness,
                       .normal = stance.normal,
                       .start = start});
}

Vec3 SkinPotential::sum(const Coupling& coupling, bool at_start) const {
  Vec3 sum = Vec3::Zero();
  for (const CoupledCorners& corners : coupling.corners) {
    const Body& body = *group_[corners.body];
    sum += carried(body, corners.brick, corners.weights, at_start ? starts_[corners.body] : body.positions);
  }
  return sum;
}

/// How far the point has been pushed in, m.
double SkinPotential::depth(const ActiveContact& active, const Vec3& now) const {
  return std::max(0.0, -active.normal.dot(now) - watches_[active.watch].initial_penetration);
}

void SkinPotential::remember(const std::vector<Eigen::VectorXd*>& penetrations) const {
  for (std::size_t i = 0; i < group_.size(); ++i) {
    penetrations[i]->setZero(skins_[i]->points.size());
  }
  for (const ActiveContact& active : contacts_) {
    if (active.is_glue) continue;
    const ContactCandidates& pairs = *watches_[active.watch].pairs;
    const TrackedPoint& point = pairs.tracked(watches_[active.watch].pair->point);
    double& deepest = (*penetrations[point.body])[point.point];
    deepest = std::max(deepest, depth(active, sum(active.coupling, false)));
  }
}

double SkinPotential::update_friction() {
  double change = 0;
  std::vector<double> normal_force(watches_.size());
  for (const ActiveContact& active : contacts_) {
    if (active.is_glue) continue;
    normal_force[active.watch] = active.stiffness * depth(active, sum(active.coupling, false));
  }
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    if (watches_[i].friction > 0) change = std::max(change, std::abs(normal_force[i] - watches_[i].normal_force));
    watches_[i].normal_force = normal_force[i];
  }
  return change;
}

double SkinPotential::largest_normal_force() const {
  double largest = 0;
  for (const Watch& watch : watches_) largest = std::max(largest, watch.normal_force);
  return largest;
}

FrictionPotential SkinPotential::friction_at(const ActiveContact& active, const Vec3& now) const {
  const Watch& watch = watches_[active.watch];
  return {now - active.start, active.normal, watch.friction * watch.normal_force, slip_};
}

double SkinPotential::add_forces(const std::vector<Points*>& forces) const {
  double energy = 0;
  for (const ActiveContact& active : contacts_) {
    const Vec3 now = sum(active.coupling, false);
    Vec3 force;
    if (active.is_glue) {
      energy += 0.5 * active.stiffness * now.squaredNorm();
      force = -active.stiffness * now;
    } else {
      const double deep = depth(active, now);
      if (deep == 0 && watches_[active.watch].normal_force == 0) continue;
      const FrictionPotential friction = friction_at(active, now);
      energy += 0.5 * active.stiffness * deep * deep;
      energy += friction.energy();
      force = active.stiffness * deep * active.normal + friction.force();
    }
    for (const CoupledCorners& corners : active.coupling.corners) {
      const auto& nodes = group_[corners.body]->grid.nodes[corners.brick];
      for (std::size_t c = 0; c < 8; ++c) {
        forces[corners.body]->row(nodes[c]) += corners.weights[c] * force.transpose();
      }
    }
  }
  return energy;
}

std::vector<Coupling> SkinPotential::couplings() const {
  std::vector<Coupling> couplings;
  for (const ActiveContact& active : contacts_) {
    const Vec3 now = sum(active.coupling, false);
    Mat3 stiffness = Mat3::Zero();
    if (active.is_glue) {
      stiffness = active.stiffness * Mat3::Identity();
    } else {
      const bool is_in_contact = depth(active, now) > 0;
      if (!is_in_contact && watches_[active.watch].normal_force == 0) continue;
      stiffness = friction_at(active, now).stiffness();
      if (is_in_contact) stiffness += active.stiffness * active.normal * active.normal.transpose();
    }
    couplings.push_back({.corners = active.coupling.corners, .stiffness = stiffness});
  }
  return couplings;
}

}  // namespace sprung
