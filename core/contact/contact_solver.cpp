#include "core/contact/contact_solver.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/contact/glue.h"

namespace sprung {
namespace {

constexpr int kMostSweeps = 30;
constexpr int kMostSweepsOfSqueezes = 100;  // rare, and what they miss grows
constexpr double kTolerance = 1e-4;         // bricks that a point may miss its limit by in a step
constexpr double kLeastFree = 0.05;         // of a contact's weights: what nodes that are held carry, none moves

double dot(double a, double b) { return a * b; }
double dot(const Vec3& a, const Vec3& b) { return a.dot(b); }
double largest(double a) { return std::abs(a); }
double largest(const Vec3& a) { return a.cwiseAbs().maxCoeff(); }

}  // namespace

ContactSolver::ContactSolver(Group group, std::vector<Eigen::VectorXd> inverse_masses, std::vector<GluedPoint> glue,
                             std::shared_ptr<SkinContacts> skin_contacts)
    : group_(std::move(group)),
      inverse_masses_(std::move(inverse_masses)),
      glue_(std::move(glue)),
      smallest_brick_(smallest_brick(group_)),
      obstacle_contact_(skins_),
      skin_contacts_(skin_contacts ? std::move(skin_contacts)
                                   : std::make_shared<SkinContacts>(group_, ContactSearch::kInTime)),
      squeeze_watches_(group_.size()) {
  for (SoftBody* actor : group_) {
    skins_.push_back(&contact_surface_of(*actor));
    places_.emplace_back(actor->node_count(), -1);
  }
}

Vec3 ContactSolver::ContactConstraint::residual(const Nodes& all, Vec3 Pushed::*velocity) const {
  Vec3 result = goal;
  for (const Part& part : parts) result -= part.weight * all[part.place].*velocity;
  return result;
}

void ContactSolver::ContactConstraint::push(const Vec3& size, Nodes& all) const {
  for (const Part& part : parts) all[part.place].now += part.weight * size;
}

Vec3 ContactSolver::ContactConstraint::allowed(const Vec3& size) const {
  return is_glue ? size : within_friction_cone(size, normal, friction);
}

double ContactSolver::InversionConstraint::residual(const Nodes& all, Vec3 Pushed::*velocity) const {
  double result = least_speed;
  for (std::size_t i = 0; i < node_count; ++i) result -= gradients[i].dot(all[nodes[i]].*velocity);
  return result;
}

void ContactSolver::InversionConstraint::push(double size, Nodes& all) const {
  for (std::size_t i = 0; i < node_count; ++i) all[nodes[i]].now += size * gradients[i];
}

double ContactSolver::InversionConstraint::allowed(double size) { return std::max(0.0, size); }

std::size_t ContactSolver::place_of(std::size_t actor, int node) {
  int& place = places_[actor][node];
  if (place < 0) {
    place = isize(nodes_);
    const Vec3 velocity = group_[actor]->velocities.row(node);
    nodes_.push_back({.actor = actor,
                      .node = node,
                      .inverse_mass = inverse_masses_[actor][node],
                      .free_velocity = velocity,
                      .velocity = velocity});
  }
  return place;
}

void ContactSolver::forget_limits() {
  for (const Pushed& node : nodes_) places_[node.actor][node.node] = -1;
  nodes_.clear();
  std::swap(touches_, touches_before_);
  std::swap(squeezed_, squeezed_before_);
  touches_.clear();
  squeezed_.clear();
}

bool ContactSolver::can_be_moved(std::span<const Part> parts) const {
  double all = 0;
  double free = 0;
  for (const Part& part : parts) {
    all += std::abs(part.weight);
    if (nodes_[part.place].inverse_mass > 0) free += std::abs(part.weight);
  }
  return free > kLeastFree * all;
}

void ContactSolver::find_contacts(const World& world, double elapsed, double dt) {
  found_.clear();
  if (!world.obstacles.empty()) {
    std::vector<Pose> poses;
    for (const Obstacle& obstacle : world.obstacles) poses.push_back(pose_after(obstacle, elapsed));
    obstacle_contact_.find(world, poses, dt, group_, found_);
  }
  skin_contacts_->find(world, dt, group_, found_);
  add_glue(glue_, group_, dt, found_);
  std::sort(found_.list.begin(), found_.list.end(), [](const Contact& a, const Contact& b) { return a.key < b.key; });
  parts_.clear();
  for (const Share& share : found_.shares) {
    parts_.push_back({place_of(share.actor, share.node), share.weight});
  }
  for (const Contact& touch : found_.list) {
    const std::span<const Part> parts = std::span(parts_).subspan(touch.first, touch.last - touch.first);
    if (!can_be_moved(parts)) continue;
    touches_.push_back({.key = touch.key,
                        .parts = parts,
                        .normal = touch.normal,
                        .goal = touch.goal,
                        .friction = touch.friction,
                        .is_glue = touch.is_glue});
  }
}

void ContactSolver::find_inversions(double dt) {
  std::vector<const std::vector<InversionRate>*> found(group_.size());
  tbb::parallel_for(std::size_t{0}, group_.size(),
                    [&](std::size_t actor) { found[actor] = &squeeze_watches_[actor].find(*group_[actor], dt); });
  for (std::size_t actor = 0; actor < group_.size(); ++actor) add_inversions(actor, *found[actor]);
}

void ContactSolver::add_inversions(std::size_t actor, const std::vector<InversionRate>& squeezes) {
  const Body& body = *group_[actor];
  for (const InversionRate& squeeze : squeezes) {
    const auto& nodes = body.grid.nodes[squeeze.brick];
    const double size = body.grid.brick_size;  // so that both kinds of limit measure speeds
    const Eigen::Matrix<double, 3, 8> gradients = size * corner_gradients(squeeze);
    InversionConstraint limit{
        .key = touch_key(0, actor, squeeze.brick, 0) * 2 + static_cast<std::uint64_t>(squeeze.corner),
        .least_speed = squeeze.least_rate * size};
    for (int corner = 0; corner < 8; ++corner) {
      if (gradients.col(corner).isZero(0)) continue;
      limit.gradients[limit.node_count] = gradients.col(corner);
      limit.nodes[limit.node_count] = place_of(actor, nodes[corner]);
      ++limit.node_count;
    }
    squeezed_.push_back(limit);
  }
}

void ContactSolver::compute_row_sums() {
  each_limit([&](const auto& limit) {
    for (std::size_t i = 0; i < limit.count(); ++i) nodes_[limit.place(i)].pull += limit.pull(i);
  });
  each_limit([&](auto& limit) {
    for (std::size_t i = 0; i < limit.count(); ++i) {
      const Pushed& node = nodes_[limit.place(i)];
      limit.inverse_mass += limit.pull(i) * node.inverse_mass * node.pull;
    }
  });
}

void ContactSolver::warm_start() {
  const auto take_over = [](const auto& before, auto& limits) {
    auto old = before.begin();
    for (auto& limit : limits) {
      while (old != before.end() && old->key < limit.key) ++old;
      if (old != before.end() && old->key == limit.key && limit.inverse_mass > 0) limit.impulse = old->impulse;
    }
  };
  take_over(touches_before_, touches_);
  take_over(squeezed_before_, squeezed_);
  // The best share of these impulses is that whose residual has least energy; it has no more than without impulses.
  double wanted = 0;
  each_limit([&](const auto& limit) {
    wanted += dot(limit.residual(nodes_, &Pushed::free_velocity), limit.impulse.last);
    limit.push(limit.impulse.last, nodes_);
  });
  double answered = 0;
  for (const Pushed& node : nodes_) answered += node.inverse_mass * node.now.squaredNorm();
  const double share = answered > 0 ? std::clamp(wanted / answered, 0.0, 1.0) : 0;
  each_limit([&](auto& limit) {
    limit.impulse.last *= share;
    limit.impulse.ahead = limit.impulse.last;
  });
  for (Pushed& node : nodes_) {
    node.last = share * node.now;
    node.velocity = node.free_velocity + node.inverse_mass * node.last;
    node.now.setZero();
  }
}

ContactSolver::Sweep ContactSolver::sweep() {
  Sweep result;
  each_limit([&](auto& limit) {
    if (limit.inverse_mass <= 0) return;
    auto& [last, ahead] = limit.impulse;
    using Impulse = std::remove_reference_t<decltype(last)>;
    const Impulse wanted = ahead + limit.residual(nodes_, &Pushed::velocity) / limit.inverse_mass;
    const Impulse size = limit.allowed(wanted);
    limit.push(size, nodes_);
    const Impulse change = size - ahead;
    result.furthest = std::max(result.furthest, largest(change) * limit.inverse_mass);
    result.uphill -= dot(change, Impulse(size - last)) * limit.inverse_mass;
    ahead = last;
    last = size;
  });
  return result;
}

void ContactSolver::extrapolate(double lead) {
  // What is ahead still holds the sweep before.
  each_limit([&](auto& limit) {
    auto& [last, ahead] = limit.impulse;
    ahead = last + lead * (last - ahead);
  });
  for (Pushed& node : nodes_) {
    node.velocity = node.free_velocity + node.inverse_mass * (node.now + lead * (node.now - node.last));
    node.last = node.now;
    node.now.setZero();
  }
}

void ContactSolver::apply(const World& world, double elapsed, double dt) {
  forget_limits();
  find_contacts(world, elapsed, dt);
  find_inversions(dt);
  if (nodes_.empty()) return;
  compute_row_sums();
  warm_start();
  const int most = squeezed_.empty() ? kMostSweeps : kMostSweepsOfSqueezes;
  const double tolerance = kTolerance * smallest_brick_ / dt;
  double momentum = 1;  // Nesterov's sequence
  for (int i = 0; i < most; ++i) {
    const Sweep done = sweep();
    if (done.uphill > 0) momentum = 1;
    const double next = (1 + std::sqrt(1 + 4 * momentum * momentum)) / 2;
    const bool is_last = i + 1 == most || !(done.furthest >= tolerance);
    extrapolate(is_last || done.uphill > 0 ? 0 : (momentum - 1) / next);
    if (is_last) break;
    momentum = next;
  }
  for (const Pushed& node : nodes_) group_[node.actor]->velocities.row(node.node) = node.velocity.transpose();
}

}  // namespace sprung
