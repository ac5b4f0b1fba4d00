#include "core/contact/pairs/crossing_guard.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/contact/search/obstacle_surface.h"

namespace sprung {
namespace {

constexpr int kMostLooks = 20;         // in a step, after each of which something moved in a way that was not foreseen
constexpr double kMostStepsAhead = 8;  // that are looked ahead ...
constexpr double kWayAhead = 0.02;     // ... or fewer, in which nothing moves by more than so many bricks
constexpr double kSlack = 0.005;       // bricks that nodes may be away from where their velocities would take them ...
constexpr double kSlackOfMore = 0.05;  // ... when a step is looked at once more
constexpr int kImpulseRounds = 12;     // of impulses between corners ...
constexpr int kSlowRounds = 36;        // ... then, up to here, of nodes that are slowed down ...
constexpr int kMostRounds = 60;        // ... and of nodes that move as one
constexpr double kShareOfEach = 0.45;  // of what two features may come closer, that each may use

/// m, that two features may come closer in a step; below 0: that they have to get apart.
double free_way(const AwakePair& pair, double brick) { return kFreeShare * (pair.gap - kLeastGap * brick); }

/// The weights of the corners that come closest.
Eigen::Vector4d worst_corners(const AwakePair& pair, const Eigen::Vector4d& speeds) {
  const int count = pair.pair.count;
  Eigen::Index slowest = 0;
  Eigen::Index fastest = 0;
  speeds.head(count).minCoeff(&slowest);
  speeds.tail(4 - count).maxCoeff(&fastest);
  Eigen::Vector4d weights = Eigen::Vector4d::Zero();
  weights[slowest] = 1;
  weights[count + fastest] = -1;
  return weights;
}

}  // namespace

CrossingGuard::CrossingGuard(const Group& group, const World& world) : group_(group), brick_(smallest_brick(group)) {
  for (std::size_t row = 0; row < world.obstacles.size(); ++row) {
    std::optional<SoftBody> surface = obstacle_surface(world.obstacles[row], brick_);
    if (!surface) continue;
    obstacles_.push_back(std::make_unique<SoftBody>(std::move(*surface)));
    obstacle_rows_.push_back(row);
  }
  for (std::size_t row = 0; row < group_.size() + obstacles_.size(); ++row) {
    trees_.push_back(std::make_unique<SurfaceTree>(contact_surface_of(body(row)), body(row)));
  }
  const auto add = [&](std::size_t a, std::size_t b) {
    pairs_.push_back(std::make_unique<FeaturePairs>(*trees_[a], *trees_[b], std::array{a, b}));
  };
  for (std::size_t a = 0; a < group_.size(); ++a) {
    if (group_[a]->collides_with_itself) add(a, a);
    for (std::size_t b = a + 1; b < trees_.size(); ++b) {
      if (b >= group_.size() || world.bodies_collide) add(a, b);
    }
  }
}

SoftBody& CrossingGuard::body(std::size_t row) const {
  return row < group_.size() ? *group_[row] : *obstacles_[row - group_.size()];
}

const ContactPoint& CrossingGuard::point(const AwakePair& pair, int corner) const {
  return trees_[pair.bodies[pair.pair.side(corner)]]->skin().points[pair.pair.corners[corner]];
}

Eigen::Vector4d CrossingGuard::speeds(const AwakePair& pair, bool are_known) const {
  Eigen::Vector4d speeds;
  for (int corner = 0; corner < 4; ++corner) {
    const std::size_t row = pair.bodies[pair.pair.side(corner)];
    const SoftBody& of = body(row);
    speeds[corner] = pair.normal.dot(are_known ? trees_[row]->velocity_of(pair.pair.corners[corner])
                                               : carried(of, point(pair, corner), of.velocities));
  }
  return speeds;
}

void CrossingGuard::apply(const World& world, const std::vector<Eigen::VectorXd>& inverse_masses, double elapsed,
                          double dt) {
  inverse_masses_ = &inverse_masses;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    move_surface(world.obstacles[obstacle_rows_[i]], elapsed, dt, *obstacles_[i]);
  }
  for (int look = 0; look < kMostLooks; ++look) {
    if (!is_foreseen(dt)) look_ahead(dt, look == 0 ? kSlack : kSlackOfMore);
    for (const auto& tree : trees_) tree->refresh();
    awake_.clear();
    for (const auto& pairs : pairs_) pairs->measure(awake_);
    if (!keep_apart(dt) || is_foreseen(dt)) break;
  }
  since_look_ += dt;
}

bool CrossingGuard::is_foreseen(double dt) const {
  if (seen_.empty() || since_look_ + dt > horizon_ * (1 + 1e-9)) return false;
  const double most = slack_ * brick_;
  for (std::size_t row = 0; row < seen_.size(); ++row) {
    const Body& now = body(row);
    const Seen& seen = seen_[row];
    const double allowed = most / trees_[row]->spread();
    const auto off = now.positions + dt * now.velocities - seen.positions - (since_look_ + dt) * seen.velocities;
    if (!(off.rowwise().squaredNorm().maxCoeff() <= allowed * allowed)) return false;
  }
  return true;
}

void CrossingGuard::look_ahead(double dt, double slack) {
  double fastest = 0;
  for (const auto& tree : trees_) fastest = std::max(fastest, tree->fastest());
  const double steps = kWayAhead * brick_ / (2 * fastest * dt);
  horizon_ = dt * (steps < kMostStepsAhead ? std::max(1.0, std::floor(steps)) : kMostStepsAhead);
  slack_ = slack;
  since_look_ = 0;
  seen_.resize(trees_.size());
  tbb::parallel_for(std::size_t{0}, trees_.size(), [&](std::size_t row) {
    seen_[row] = {body(row).positions, body(row).velocities};
    trees_[row]->follow(horizon_, slack_ * brick_);
  });
  for (const auto& pairs : pairs_) pairs->wake();
}

bool CrossingGuard::keep_apart(double dt) {
  bool has_changed = false;
  for (int round = 0; round < kMostRounds; ++round) {
    bool is_kept = true;
    for (const AwakePair& pair : awake_) {
      const Eigen::Vector4d speed = speeds(pair, !has_changed);
      const int count = pair.pair.count;
      const double closing = speed.tail(4 - count).maxCoeff() - speed.head(count).minCoeff();
      if (!(closing * dt > free_way(pair, brick_))) continue;
      is_kept = false;
      has_changed = true;
      if (round < kImpulseRounds) {
        const bool is_at_places = -pair.weights.dot(speed) * dt > free_way(pair, brick_);
        push(pair, speed, is_at_places ? pair.weights : worst_corners(pair, speed), dt);
      } else if (round < kSlowRounds) {
        slow_nodes(pair, speed, dt);
      } else {
        unite(pair);
      }
    }
    if (is_kept) return has_changed;
  }
  return false;
}

template <class Visit>
void CrossingGuard::each_node(const AwakePair& pair, int corner, const Visit& visit) const {
  const std::size_t row = pair.bodies[pair.pair.side(corner)];
  const ContactPoint& at = point(pair, corner);
  for (int i = 0; i < 8; ++i) {
    if (at.weights[i] != 0) visit(row, body(row).grid.nodes[at.brick][i], at.weights[i]);
  }
}

bool CrossingGuard::is_held(const AwakePair& pair, int corner) const {
  bool is_held = true;
  each_node(pair, corner, [&](std::size_t row, int node, double) { is_held &= inverse_mass(row, node) == 0; });
  return is_held;
}

void CrossingGuard::push(const AwakePair& pair, const Eigen::Vector4d& speeds, const Eigen::Vector4d& weights,
                         double dt) {
  struct Pushed {
    std::size_t row;
    int node;
    double weight;
  };
  std::array<Pushed, 32> parts;
  std::size_t count = 0;
  for (int corner = 0; corner < 4; ++corner) {
    if (weights[corner] == 0) continue;
    each_node(pair, corner, [&](std::size_t row, int node, double weight) {
      if (inverse_mass(row, node) == 0) return;
      const auto end = parts.begin() + count;
      const auto known =
          std::find_if(parts.begin(), end, [&](const Pushed& part) { return part.node == node && part.row == row; });
      if (known == end) parts[count++] = {row, node, 0};
      known->weight += weights[corner] * weight;
    });
  }
  double answer = 0;  // 1/kg
  for (std::size_t i = 0; i < count; ++i) {
    answer += parts[i].weight * parts[i].weight * inverse_mass(parts[i].row, parts[i].node);
  }
  if (!(answer > 0)) return;
  const double way = free_way(pair, brick_);
  const double impulse = ((way > 0 ? -0.5 * way : -way) / dt - weights.dot(speeds)) / answer;
  for (std::size_t i = 0; i < count; ++i) {
    const double change = impulse * parts[i].weight * inverse_mass(parts[i].row, parts[i].node);
    body(parts[i].row).velocities.row(parts[i].node) += (change * pair.normal).transpose();
  }
}

void CrossingGuard::slow_nodes(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt) {
  const int count = pair.pair.count;
  const bool is_first_held = is_held(pair, 0) && (count == 1 || is_held(pair, 1));
  const bool is_second_held = is_held(pair, 2) && is_held(pair, 3) && (count == 2 || is_held(pair, 1));
  double together = speeds.mean();
  if (is_first_held) together = speeds.head(count).minCoeff();
  if (is_second_held) together = speeds.tail(4 - count).maxCoeff();
  const double share = is_first_held || is_second_held ? 2 * kShareOfEach : kShareOfEach;
  const double most = share * std::max(0.0, free_way(pair, brick_)) / dt;
  for (int corner = 0; corner < 4; ++corner) {
    const double sign = corner < count ? 1 : -1;
    each_node(pair, corner, [&](std::size_t row, int node, double) {
      if (inverse_mass(row, node) == 0) return;
      auto velocity = body(row).velocities.row(node);
      const double speed = sign * (velocity.dot(pair.normal.transpose()) - together);
      if (speed < -most) velocity -= (sign * (speed + most) * pair.normal).transpose();
    });
  }
}

void CrossingGuard::unite(const AwakePair& pair) {
  Vec3 momentum = Vec3::Zero();
  double mass = 0;
  Vec3 held_velocity = Vec3::Zero();
  int held = 0;
  for (int corner = 0; corner < 4; ++corner) {
    if (is_held(pair, corner)) {
      const SoftBody& of = body(pair.bodies[pair.pair.side(corner)]);
      held_velocity += carried(of, point(pair, corner), of.velocities);
      ++held;
      continue;
    }
    each_node(pair, corner, [&](std::size_t row, int node, double) {
      if (inverse_mass(row, node) == 0) return;
      momentum += Vec3(body(row).velocities.row(node)) / inverse_mass(row, node);
      mass += 1 / inverse_mass(row, node);
    });
  }
  if (held == 4) return;
  const Vec3 velocity = held > 0 ? Vec3(held_velocity / held) : Vec3(momentum / mass);
  for (int corner = 0; corner < 4; ++corner) {
    each_node(pair, corner, [&](std::size_t row, int node, double) {
      if (inverse_mass(row, node) > 0) body(row).velocities.row(node) = velocity.transpose();
    });
  }
}

}  // namespace sprung
