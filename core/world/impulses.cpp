#include "core/world/impulses.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/bricks/corner.h"

namespace sprung {
namespace {

constexpr int kMostSweeps = 8;
constexpr int kMostSweepsOfSqueezes = 40;  // rare, and what they miss grows
constexpr double kTolerance = 1e-5;  // bricks that a point, or volumes that a brick, may miss its limit by in a step

}  // namespace

Impulses::Impulses(const Actor& actor, Eigen::VectorXd inverse_masses)
    : inverse_masses_(std::move(inverse_masses)),
      contact_(actor),
      shares_(Eigen::VectorXd::Zero(actor.body.node_count())),
      changes_(Points::Zero(actor.body.node_count(), 3)) {}

Impulses::Limit Impulses::limit_of(const Touch& touch, const Ground& ground, const Body& body) {
  Limit limit;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const double weight = touch.weights[static_cast<Eigen::Index>(corner)];
    if (weight == 0) continue;
    const int node = body.grid.nodes[static_cast<std::size_t>(touch.brick)][corner];
    limit.pulls[limit.pull_count++] = {.node = node, .gradient = Vec3(0, weight, 0), .weight = weight};
  }
  limit.friction = ground.friction;
  limit.least_rate = touch.least_speed;
  limit.tolerance = kTolerance * body.grid.brick_size;
  return limit;
}

Impulses::Limit Impulses::limit_of(const Squeeze& squeeze, const Body& body) {
  Limit limit;
  const auto& nodes = body.grid.nodes[static_cast<std::size_t>(squeeze.brick)];
  Pull own{.node = nodes[static_cast<std::size_t>(squeeze.corner)], .gradient = Vec3::Zero(), .weight = 0};
  for (int axis = 0; axis < 3; ++axis) {
    const double side = on_high_side(squeeze.corner, axis) ? 1 : -1;
    own.gradient += side * squeeze.gradient.col(axis);
    const int node = nodes[static_cast<std::size_t>(squeeze.corner ^ 1 << axis)];
    limit.pulls[limit.pull_count++] = {.node = node, .gradient = -side * squeeze.gradient.col(axis), .weight = 0};
  }
  limit.pulls[limit.pull_count++] = own;
  limit.least_rate = squeeze.least_rate;
  limit.tolerance = kTolerance;
  return limit;
}

void Impulses::find_limits(const World& world, double dt, const Body& body) {
  limits_.clear();
  if (world.ground) {
    for (const Touch& touch : contact_.find(*world.ground, world.gravity.norm(), dt, body)) {
      limits_.push_back(limit_of(touch, *world.ground, body));
    }
  }
  const std::vector<Squeeze>& squeezes = squeezes_.find(body, dt);
  for (const Squeeze& squeeze : squeezes) limits_.push_back(limit_of(squeeze, body));
  most_sweeps_ = squeezes.empty() ? kMostSweeps : kMostSweepsOfSqueezes;
  for (Limit& limit : limits_) limit.tolerance /= dt;
}

void Impulses::share_masses() {
  for (const int node : touched_) shares_[node] = 0;
  touched_.clear();
  for (const Limit& limit : limits_) {
    for (const Pull& pull : std::span(limit.pulls.data(), limit.pull_count)) {
      if (shares_[pull.node] == 0) touched_.push_back(pull.node);
      shares_[pull.node] += 1;
    }
  }
  for (Limit& limit : limits_) {
    for (const Pull& pull : std::span(limit.pulls.data(), limit.pull_count)) {
      limit.inverse_mass += shares_[pull.node] * inverse_masses_[pull.node] * pull.gradient.squaredNorm();
    }
  }
}

double Impulses::push(const Points& velocities, Limit& limit) {
  if (limit.inverse_mass <= 0) return 0;
  const std::span pulls(limit.pulls.data(), limit.pull_count);
  double rate = 0;
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();
  for (const Pull& pull : pulls) {
    const Vec3 velocity = velocities.row(pull.node);
    rate += pull.gradient.dot(velocity);
    slip += pull.weight * Eigen::Vector2d(velocity.x(), velocity.z());
  }
  const double normal = std::max(0.0, limit.normal + (limit.least_rate - rate) / limit.inverse_mass);
  Eigen::Vector2d tangential = limit.tangential - slip / limit.inverse_mass;
  const double most = limit.friction * normal;
  if (tangential.norm() > most) tangential *= most / tangential.norm();
  const double press = normal - limit.normal;
  const Eigen::Vector2d rub = tangential - limit.tangential;
  limit.normal = normal;
  limit.tangential = tangential;
  for (const Pull& pull : pulls) {
    const Vec3 impulse = press * pull.gradient + pull.weight * Vec3(rub.x(), 0, rub.y());
    changes_.row(pull.node) += inverse_masses_[pull.node] * impulse.transpose();
  }
  return std::max(std::abs(press), rub.norm()) * limit.inverse_mass / limit.tolerance;
}

double Impulses::sweep(Body& body) {
  for (const int node : touched_) changes_.row(node).setZero();
  double worst = 0;
  for (Limit& limit : limits_) worst = std::max(worst, push(body.velocities, limit));
  for (const int node : touched_) body.velocities.row(node) += changes_.row(node);
  return worst;
}

void Impulses::apply(const World& world, double dt, Actor& actor) {
  find_limits(world, dt, actor.body);
  if (limits_.empty()) return;
  share_masses();
  for (int sweeps = 0; sweeps < most_sweeps_; ++sweeps) {
    if (!(sweep(actor.body) >= 1)) break;
  }
}

}  // namespace sprung
