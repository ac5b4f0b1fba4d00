#include "core/contact/contact_solver.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/contact/glue.h"

namespace sprung {
namespace {

constexpr int kMaxSweeps = 30;
constexpr int kMaxSweepsWithInversions = 100;  // rare, and their errors grow
constexpr double kTolerance = 1e-4;            // bricks that a point may miss its constraint by in a step

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
      inversion_guards_(group_.size()) {
  for (SoftBody* body : group_) {
    skins_.push_back(&contact_surface_of(*body));
    rows_.emplace_back(body->node_count(), -1);
  }
}

Vec3 ContactSolver::ContactConstraint::residual(const Nodes& all, Vec3 SolverNode::*velocity) const {
  Vec3 result = goal;
  for (const JacobianEntry& entry : entries) result -= entry.weight * all[entry.index].*velocity;
  return result;
}

void ContactSolver::ContactConstraint::push(const Vec3& size, Nodes& all) const {
  for (const JacobianEntry& entry : entries) all[entry.index].now += entry.weight * size;
}

Vec3 ContactSolver::ContactConstraint::allowed(const Vec3& size) const {
  return is_glue ? size : within_friction_cone(size, normal, friction);
}

double ContactSolver::InversionConstraint::residual(const Nodes& all, Vec3 SolverNode::*velocity) const {
  double result = min_speed;
  for (std::size_t i = 0; i < node_count; ++i) result -= gradients[i].dot(all[nodes[i]].*velocity);
  return result;
}

void ContactSolver::InversionConstraint::push(double size, Nodes& all) const {
  for (std::size_t i = 0; i < node_count; ++i) all[nodes[i]].now += size * gradients[i];
}

double ContactSolver::InversionConstraint::allowed(double size) { return std::max(0.0, size); }

std::size_t ContactSolver::row_of(std::size_t body, int node) {
  int& index = rows_[body][node];
  if (index < 0) {
    index = isize(nodes_);
    const Vec3 velocity = group_[body]->velocities.row(node);
    nodes_.push_back({.body = body,
                      .node = node,
                      .inverse_mass = inverse_masses_[body][node],
                      .free_velocity = velocity,
                      .velocity = velocity});
  }
  return index;
}

void ContactSolver::clear_constraints() {
  for (const SolverNode& node : nodes_) rows_[node.body][node.node] = -1;
  nodes_.clear();
  std::swap(contacts_, contacts_before_);
  std::swap(inversions_, inversions_before_);
  contacts_.clear();
  inversions_.clear();
}

bool ContactSolver::can_be_moved(std::span<const JacobianEntry> entries) const {
  double all = 0;
  double movable = 0;
  for (const JacobianEntry& entry : entries) {
    all += std::abs(entry.weight);
    if (nodes_[entry.index].inverse_mass > 0) movable += std::abs(entry.weight);
  }
  return movable > kMinFree * all;
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
  entries_.clear();
  for (const Share& share : found_.shares) {
    entries_.push_back({row_of(share.body, share.node), share.weight});
  }
  for (const Contact& contact : found_.list) {
    const std::span<const JacobianEntry> entries =
        std::span(entries_).subspan(contact.first, contact.last - contact.first);
    if (!can_be_moved(entries)) continue;
    contacts_.push_back({.key = contact.key,
                         .entries = entries,
                         .normal = contact.normal,
                         .goal = contact.goal,
                         .friction = contact.friction,
                         .is_glue = contact.is_glue});
  }
}

void ContactSolver::find_inversions(double dt) {
  std::vector<const std::vector<InversionRate>*> found(group_.size());
  tbb::parallel_for(std::size_t{0}, group_.size(),
                    [&](std::size_t body) { found[body] = &inversion_guards_[body].find(*group_[body], dt); });
  for (std::size_t body = 0; body < group_.size(); ++body) add_inversions(body, *found[body]);
}

void ContactSolver::add_inversions(std::size_t row, const std::vector<InversionRate>& rates) {
  const Body& body = *group_[row];
  for (const InversionRate& rate : rates) {
    const auto& nodes = body.grid.nodes[rate.brick];
    const double size = body.grid.brick_size;  // so that both kinds of constraint measure speeds
    const Eigen::Matrix<double, 3, 8> gradients = size * corner_gradients(rate);
    InversionConstraint constraint{
        .key = contact_key(0, row, rate.brick, 0) * 2 + static_cast<std::uint64_t>(rate.corner),
        .min_speed = rate.min_rate * size};
    for (int corner = 0; corner < 8; ++corner) {
      if (gradients.col(corner).isZero(0)) continue;
      constraint.gradients[constraint.node_count] = gradients.col(corner);
      constraint.nodes[constraint.node_count] = row_of(row, nodes[corner]);
      ++constraint.node_count;
    }
    inversions_.push_back(constraint);
  }
}

void ContactSolver::compute_row_sums() {
  each_constraint([&](const auto& constraint) {
    for (std::size_t i = 0; i < constraint.count(); ++i) nodes_[constraint.index(i)].row_sum += constraint.weight(i);
  });
  each_constraint([&](auto& constraint) {
    for (std::size_t i = 0; i < constraint.count(); ++i) {
      const SolverNode& node = nodes_[constraint.index(i)];
      constraint.inverse_mass += constraint.weight(i) * node.inverse_mass * node.row_sum;
    }
  });
}

void ContactSolver::warm_start() {
  const auto take_over = [](const auto& before, auto& constraints) {
    auto old = before.begin();
    for (auto& constraint : constraints) {
      while (old != before.end() && old->key < constraint.key) ++old;
      if (old != before.end() && old->key == constraint.key && constraint.inverse_mass > 0)
        constraint.impulse = old->impulse;
    }
  };
  take_over(contacts_before_, contacts_);
  take_over(inversions_before_, inversions_);
  // The best multiple of these impulses has the residual of least energy, no more than without impulses.
  double wanted = 0;
  each_constraint([&](const auto& constraint) {
    wanted += dot(constraint.residual(nodes_, &SolverNode::free_velocity), constraint.impulse.last);
    constraint.push(constraint.impulse.last, nodes_);
  });
  double response = 0;
  for (const SolverNode& node : nodes_) response += node.inverse_mass * node.now.squaredNorm();
  const double share = response > 0 ? std::clamp(wanted / response, 0.0, 1.0) : 0;
  each_constraint([&](auto& constraint) {
    constraint.impulse.last *= share;
    constraint.impulse.ahead = constraint.impulse.last;
  });
  for (SolverNode& node : nodes_) {
    node.last = share * node.now;
    node.velocity = node.free_velocity + node.inverse_mass * node.last;
    node.now.setZero();
  }
}

ContactSolver::Sweep ContactSolver::sweep() {
  Sweep result;
  each_constraint([&](auto& constraint) {
    if (constraint.inverse_mass <= 0) return;
    auto& [last, ahead] = constraint.impulse;
    using Impulse = std::remove_reference_t<decltype(last)>;
    const Impulse wanted = ahead + constraint.residual(nodes_, &SolverNode::velocity) / constraint.inverse_mass;
    const Impulse size = constraint.allowed(wanted);
    constraint.push(size, nodes_);
    const Impulse change = size - ahead;
    result.furthest = std::max(result.furthest, largest(change) * constraint.inverse_mass);
    result.uphill -= dot(change, Impulse(size - last)) * constraint.inverse_mass;
    ahead = last;
    last = size;
  });
  return result;
}

void ContactSolver::extrapolate(double lead) {
  // `ahead` still holds the previous sweep.
  each_constraint([&](auto& constraint) {
    auto& [last, ahead] = constraint.impulse;
    ahead = last + lead * (last - ahead);
  });
  for (SolverNode& node : nodes_) {
    node.velocity = node.free_velocity + node.inverse_mass * (node.now + lead * (node.now - node.last));
    node.last = node.now;
    node.now.setZero();
  }
}

void ContactSolver::apply(const World& world, double elapsed, double dt) {
  clear_constraints();
  find_contacts(world, elapsed, dt);
  find_inversions(dt);
  if (nodes_.empty()) return;
  compute_row_sums();
  warm_start();
  const int most = inversions_.empty() ? kMaxSweeps : kMaxSweepsWithInversions;
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
  for (const SolverNode& node : nodes_) group_[node.body]->velocities.row(node.node) = node.velocity.transpose();
}

}  // namespace sprung
