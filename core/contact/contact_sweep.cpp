#include "core/contact/contact_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/bricks/brick_topology.h"
#include "core/contact/contacts.h"
#include "core/contact/glue.h"
#include "core/contact/search/contact_surface.h"

namespace sprung {
namespace {

constexpr double kApproach = 0.5;  // of the way to the contact distance, by which features may approach per step
constexpr double kRecoveryHeight = 0.005;  // features that overlap separate as after a fall by that part of it
constexpr double kYield = 0.02;    // of an impulse of glue: what it leaves of the velocity, times the mass there
constexpr double kFurthest = 0.5;  // bricks at rest by which a point is moved to where friction acts
constexpr int kInversionSweeps = 4;
constexpr int kSweeps = 6;  // after one, some balls in a bowl do not come to rest

/// The least speed (m/s) along the normal of two features in contact, if they move at `speed` (m/s).
double min_speed(const AwakePair& pair, double speed, double gravity, double dt) {
  const double rest = pair.gap - pair.reach;
  if (pair.restitution > 0 && speed < 0) return rest + speed * dt > 0 ? speed : -pair.restitution * speed;
  if (rest > 0) return -kApproach * rest / dt;
  const double recovery = std::sqrt(-2 * kRecoveryHeight * std::max(gravity, kMinGravity) * rest);
  return recovery * std::min(1.0, -rest / pair.reach);
}

/// The change of a point's weights, exact in the trilinear map, that moves the point by `way` (m); 0 if its brick is
/// too flat for that.
CornerWeights weights_of_way(const Body& body, const ContactPoint& point, const Vec3& way) {
  Eigen::Matrix<double, 8, 3> rates;  // of the weights along each axis of the brick
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 8; ++corner) {
      const double along = point.weights[corner] + point.weights[corner ^ 1 << axis];
      rates(corner, axis) = on_high_side(corner, axis) ? along : -along;
    }
  }
  const Mat3 map = columns_of(body.grid.nodes[point.brick], body.positions) * rates;
  const Vec3 local = map.partialPivLu().solve(way);  // bricks
  if (!(local.squaredNorm() < kFurthest * kFurthest)) return CornerWeights::Zero();
  return rates * local;
}

}  // namespace

ContactSweep::ContactSweep(Group group, std::vector<GluedPoint> glue)
    : group_(std::move(group)),
      glue_(std::move(glue)),
      glue_impulses_(glue_.size(), Vec3::Zero()),
      inversions_(group_.size()) {
  for (const SoftBody* body : group_) {
    parts_of_nodes_.emplace_back(body->node_count(), -1);
    supports_.emplace_back(body->node_count());
  }
}

FlattestVolume ContactSweep::flattest() const {
  FlattestVolume flattest;
  for (const InversionGuard& one : inversions_) flattest = flatter_of(flattest, one.flattest());
  return flattest;
}

void ContactSweep::stop_inversions(const std::vector<Eigen::VectorXd>& inverse_masses, double dt) {
  for (std::size_t row = 0; row < group_.size(); ++row) {
    SoftBody& body = *group_[row];
    const std::vector<InversionRate>& found = inversions_[row].find(body, dt);
    for (int pass = 0; pass < kInversionSweeps && !found.empty(); ++pass) {
      for (const InversionRate& one : found) {
        const auto& nodes = body.grid.nodes[one.brick];
        const Eigen::Matrix<double, 3, 8> gradients = corner_gradients(one);
        double rate = 0;
        double response = 0;
        for (int corner = 0; corner < 8; ++corner) {
          rate += gradients.col(corner).dot(body.velocities.row(nodes[corner]));
          response += gradients.col(corner).squaredNorm() * inverse_masses[row][nodes[corner]];
        }
        if (!(rate < one.min_rate) || !(response > 0)) continue;
        const double size = (one.min_rate - rate) / response;
        for (int corner = 0; corner < 8; ++corner) {
          const double share = size * inverse_masses[row][nodes[corner]];
          body.velocities.row(nodes[corner]) += share * gradients.col(corner).transpose();
        }
      }
    }
  }
}

void ContactSweep::add_part(std::size_t body, int node, double weight, double inverse_mass, Row& row) {
  double* velocity = &group_[body]->velocities(node, 0);
  if (inverse_mass == 0) {
    row.carried += weight * Eigen::Map<const Vec3>(velocity);
    return;
  }
  int& part = parts_of_nodes_[body][node];
  if (part < 0) {
    part = isize(parts_);
    parts_.push_back({.velocity = velocity, .weight = 0, .inverse_mass = inverse_mass});
    seen_.emplace_back(body, node);
  }
  parts_[std::size_t(part)].weight += weight;
}

void ContactSweep::finish_row(Row row) {
  for (const auto& [body, node] : seen_) parts_of_nodes_[body][node] = -1;
  seen_.clear();
  row.last = parts_.size();
  row.inverse_mass = 0;
  double free = 0;
  for (std::size_t i = row.first; i < row.last; ++i) {
    free += std::abs(parts_[i].weight);
    row.inverse_mass += parts_[i].weight * parts_[i].weight * parts_[i].inverse_mass;
  }
  if (free > kMinFree && row.inverse_mass > 0) {
    rows_.push_back(row);
  } else {
    row.impulse->setZero();
    parts_.resize(row.first);
  }
}

void ContactSweep::add_contacts(NearFeatures& near, const std::vector<Eigen::VectorXd>& inverse_masses, double gravity,
                                double dt, bool are_loaded) {
  for (const AwakePair& pair : near.awake()) {
    if (pair.is_loaded != are_loaded) continue;
    if (!pair.may_support) {
      if (pair.is_loaded) pair.impulse->setZero();
      continue;
    }
    double speed = 0;
    for (int corner = 0; corner < 4 && (!are_loaded || pair.restitution > 0); ++corner) {
      if (pair.weights[corner] != 0) {
        speed += pair.weights[corner] * pair.normal.dot(near.known_velocity(pair, corner));
      }
    }
    const double least = min_speed(pair, speed, gravity, dt);
    const bool is_held = is_supported_at_node(near, pair, !are_loaded);
    if (!are_loaded && (!(speed < least - gravity * dt) || (is_held && pair.gap > kBorne * pair.reach))) continue;
    Row row{.first = parts_.size(),
            .last = 0,
            .normal = pair.normal,
            .carried = Vec3::Zero(),
            .min_speed = least,
            .friction = pair.friction,
            .inverse_mass = 0,
            .impulse = pair.impulse};
    for (int corner = 0; corner < 4; ++corner) {
      const double share = pair.weights[corner];
      if (share == 0) continue;
      const std::size_t of = pair.body_of(corner);
      if (of >= near.group_size()) {
        row.carried += share * near.known_velocity(pair, corner);
        continue;
      }
      near.each_node(pair, corner, [&](std::size_t body, int node, double weight) {
        add_part(body, node, share * weight, inverse_masses[body][node], row);
      });
    }
    if (pair.friction > 0) move_together(near, pair, inverse_masses, row);
    finish_row(row);
    if (!are_loaded) static_cast<void>(is_supported_at_node(near, pair, false));
  }
}

void ContactSweep::move_together(NearFeatures& near, const AwakePair& pair,
                                 const std::vector<Eigen::VectorXd>& inverse_masses, Row& row) {
  const std::size_t body = pair.body_of(0);
  if (body >= near.group_size() || pair.body_of(3) >= near.group_size()) return;
  const int corner = pair.pair.count == 2 && pair.weights[1] > pair.weights[0] ? 1 : 0;
  const ContactPoint& point = near.point_of(pair, corner);
  const CornerWeights change = weights_of_way(*group_[body], point, -pair.gap * pair.normal);
  const auto& nodes = group_[body]->grid.nodes[point.brick];
  for (int i = 0; i < 8; ++i) {
    if (change[i] != 0) add_part(body, nodes[i], change[i], inverse_masses[body][nodes[i]], row);
  }
}

bool ContactSweep::is_supported_at_node(NearFeatures& near, const AwakePair& pair, bool is_asked) {
  if (pair.pair.count == 2) return false;
  const std::size_t body = pair.body_of(0);
  if (body >= near.group_size()) return false;
  const std::size_t other = pair.body_of(1);
  NodeSupport& support = supports_[body][near.nearest_node(pair)];
  const bool is_held = support.step == step_ && support.other == other;
  if (!is_asked) support = {step_, other};
  return is_held;
}

void ContactSweep::add_glue_rows(const std::vector<Eigen::VectorXd>& inverse_masses, double dt) {
  for (std::size_t i = 0; i < glue_.size(); ++i) {
    const GluedPoint& point = glue_[i];
    Vec3 apart = Vec3::Zero();
    Row row{.first = parts_.size(),
            .last = 0,
            .normal = Vec3::Zero(),
            .carried = Vec3::Zero(),
            .min_speed = 0,
            .friction = 0,
            .inverse_mass = 0,
            .impulse = &glue_impulses_[i],
            .is_glue = true};
    for (std::size_t side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1 : -1;
      const std::size_t body = point.bodies[side];
      const auto& nodes = group_[body]->grid.nodes[point.bricks[side]];
      apart += sign * carried(*group_[body], point.bricks[side], point.weights[side], group_[body]->positions);
      for (int corner = 0; corner < 8; ++corner) {
        const double weight = point.weights[side][corner];
        if (weight != 0) add_part(body, nodes[corner], sign * weight, inverse_masses[body][nodes[corner]], row);
      }
    }
    row.carried += apart / (kRejoinSteps * dt);
    finish_row(row);
  }
}

Vec3 ContactSweep::velocity_of(const Row& row) const {
  Vec3 velocity = row.carried;
  for (std::size_t i = row.first; i < row.last; ++i) {
    velocity += parts_[i].weight * Eigen::Map<const Vec3>(parts_[i].velocity);
  }
  return velocity;
}

void ContactSweep::push(const Row& row, const Vec3& impulse) {
  for (std::size_t i = row.first; i < row.last; ++i) {
    Eigen::Map<Vec3>(parts_[i].velocity) += parts_[i].weight * parts_[i].inverse_mass * impulse;
  }
}

void ContactSweep::warm_start(double scale) {
  double wanted = 0;
  double response = 0;
  for (Row& row : rows_) {
    if (row.impulse->isZero(0)) continue;
    *row.impulse *= scale;
    if (!row.is_glue) *row.impulse = within_friction_cone(*row.impulse, row.normal, row.friction);
    const Vec3 velocity = velocity_of(row);
    wanted += row.impulse->dot(row.min_speed * row.normal - velocity);
    response -= row.impulse->dot(velocity);
  }
  for (const Row& row : rows_) {
    if (!row.impulse->isZero(0)) push(row, *row.impulse);
  }
  for (const Row& row : rows_) {
    if (!row.impulse->isZero(0)) response += row.impulse->dot(velocity_of(row));
  }
  const double share = response > 0 ? std::clamp(wanted / response, 0.0, 1.0) : 0;
  if (share == 1) return;
  for (const Row& row : rows_) {
    if (row.impulse->isZero(0)) continue;
    push(row, (share - 1) * *row.impulse);
    *row.impulse *= share;
  }
}

void ContactSweep::sweep() {
  for (const Row& row : rows_) {
    const double yield = row.is_glue ? kYield : 0;
    const Vec3 wanted =
        (*row.impulse + (row.min_speed * row.normal - velocity_of(row)) / row.inverse_mass) / (1 + yield);
    const Vec3 now = row.is_glue ? wanted : within_friction_cone(wanted, row.normal, row.friction);
    push(row, now - *row.impulse);
    *row.impulse = now;
  }
}

int ContactSweep::apply(NearFeatures& near, const std::vector<Eigen::VectorXd>& inverse_masses, double gravity,
                        double dt) {
  ++step_;
  stop_inversions(inverse_masses, dt);
  parts_.clear();
  rows_.clear();
  add_contacts(near, inverse_masses, gravity, dt, true);
  add_glue_rows(inverse_masses, dt);
  warm_start(dt_before_ > 0 ? dt / dt_before_ : 0);
  near.refresh_velocities();
  add_contacts(near, inverse_masses, gravity, dt, false);
  for (int i = 0; i < kSweeps; ++i) sweep();
  dt_before_ = dt;
  return int(std::count_if(rows_.begin(), rows_.end(),
                           [](const Row& row) { return !row.is_glue && !row.impulse->isZero(0); }));
}

}  // namespace sprung
