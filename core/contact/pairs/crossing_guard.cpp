#include "core/contact/pairs/crossing_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/pairs/closest_features.h"

namespace sprung {
namespace {

constexpr int kMaxLooks = 20;          // in a step, each after something deviated from the prediction
constexpr int kImpulseRounds = 12;     // of impulses between corners ...
constexpr int kSlowRounds = 36;        // ... then, up to here, of nodes that are slowed down ...
constexpr int kMaxRounds = 400;        // ... and of nodes that move as one, more from round to round
constexpr double kMaxDip = 0.8;        // of the way to zero, between the ends of a step, of a distance of corners
constexpr double kShareOfEach = 0.45;  // of the allowed approach of two features, that each may use
constexpr double kRounding = 1e-12;    // bricks by which features of nodes that move as one approach by rounding errors

/// How far two features may approach in a step, m; below 0: they must separate.
double allowed_approach(const AwakePair& pair, double brick) {
  return pair.gap < 0 ? 0 : kFreeShare * (pair.gap - kMinGap * brick);
}

/// What has crossed another surface is moved out by contact.
bool is_left_alone(const AwakePair& pair) { return pair.gap < 0 && pair.bodies[1] != AwakePair::kNoBody; }

/// The weights of the corners that approach most.
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

void CrossingGuard::apply(const World& world, const std::vector<Eigen::VectorXd>& inverse_masses, double dt) {
  inverse_masses_ = &inverse_masses;
  near_.refresh_velocities();
  static_cast<void>(near_.recheck(world, dt));
  do_pins_meet_ = false;
  Outcome outcome = Outcome::kChanged;
  int rounds = 0;
  for (int look = 0; look < kMaxLooks && outcome == Outcome::kChanged; ++look) {
    outcome = keep_apart(dt, rounds);
    if (outcome == Outcome::kChanged && !near_.recheck(world, dt)) outcome = Outcome::kUnchanged;
  }
  count(rounds, do_pins_meet_ || outcome != Outcome::kUnchanged);
}

void CrossingGuard::count(int rounds, bool has_failed) {
  counts_ += {.steps = 1,
              .impulses = rounds > 0 ? 1 : 0,
              .slowed = rounds > kImpulseRounds ? 1 : 0,
              .welded = rounds > kSlowRounds ? 1 : 0,
              .failed = has_failed ? 1 : 0};
}

bool CrossingGuard::may_meet(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt) const {
  const double least = welds_.empty() ? -std::numeric_limits<double>::infinity() : kRounding * near_.brick();
  return closing_speed(pair.pair, speeds) * dt > std::max(least, allowed_approach(pair, near_.brick())) &&
         !stay_apart_turning(pair, dt);
}

bool CrossingGuard::stay_apart_turning(const AwakePair& pair, double dt) const {
  if (pair.gap <= 0 || pair.bodies[1] == AwakePair::kNoBody) return false;
  std::array<Vec3, 4> now;
  std::array<Vec3, 4> then;
  for (int corner = 0; corner < 4; ++corner) {
    now[corner] = near_.position(pair, corner);
    then[corner] = now[corner] + dt * near_.velocity(pair, corner);
  }
  const FeatureDistance after = feature_distance(pair.pair.count, then);
  const Vec3 normal_then = after.apart.normalized();
  if (!(after.apart.norm() > pair.gap - allowed_approach(pair, near_.brick()))) return false;
  for (int i = 0; i < pair.pair.count; ++i) {
    for (int j = pair.pair.count; j < 4; ++j) {
      const Vec3 apart = now[i] - now[j];
      const Vec3 apart_then = then[i] - then[j];
      // Their distance along a normal that turns linearly is a quadratic in time; these are its Bernstein coefficients.
      const double at_first = pair.normal.dot(apart);
      const double midway = (pair.normal.dot(apart_then) + normal_then.dot(apart)) / 2;
      const double at_last = normal_then.dot(apart_then);
      if (!(at_first > 0 && at_last > 0 && midway > -kMaxDip * std::sqrt(at_first * at_last))) return false;
    }
  }
  return true;
}

bool CrossingGuard::find_met(double dt) {
  bool has_found = false;
  near_.refresh_velocities();
  is_met_.resize(near_.awake().size(), false);
  for (std::size_t row = 0; row < near_.awake().size(); ++row) {
    const AwakePair& pair = near_.awake()[row];
    if (is_left_alone(pair)) continue;
    Eigen::Vector4d speeds;
    for (int corner = 0; corner < 4; ++corner) speeds[corner] = pair.normal.dot(near_.known_velocity(pair, corner));
    if (!may_meet(pair, speeds, dt) || near_.is_entangled(row)) continue;
    if (!can_be_moved(pair)) {
      const double gap = std::max(pair.gap, kMinGap * near_.brick());
      do_pins_meet_ = do_pins_meet_ || closing_speed(pair.pair, speeds) * dt > kFreeShare * gap;
      continue;
    }
    has_found = true;
    if (!is_met_[row]) met_.push_back(row);
    is_met_[row] = true;
  }
  return has_found;
}

CrossingGuard::Outcome CrossingGuard::keep_apart(double dt, int& rounds) {
  met_.clear();
  is_met_.clear();
  welds_.clear();
  weld_of_.clear();
  bool has_changed = false;
  int round = 0;
  while (find_met(dt)) {
    has_changed = true;
    for (bool is_kept = false; !is_kept; ++round) {
      if (round == kMaxRounds) return Outcome::kFailed;
      is_kept = true;
      for (const std::size_t row : met_) {
        const AwakePair& pair = near_.awake()[row];
        Eigen::Vector4d speeds;
        for (int corner = 0; corner < 4; ++corner) speeds[corner] = pair.normal.dot(near_.velocity(pair, corner));
        if (!may_meet(pair, speeds, dt)) continue;
        is_kept = false;
        rounds = std::max(rounds, round + 1);
        if (round < kImpulseRounds) {
          const bool is_at_places = -pair.weights.dot(speeds) * dt > allowed_approach(pair, near_.brick());
          push(pair, speeds, is_at_places ? pair.weights : worst_corners(pair, speeds), dt);
        } else if (round < kSlowRounds) {
          slow_nodes(pair, speeds, dt);
        } else {
          weld(pair);
        }
      }
    }
  }
  return has_changed ? Outcome::kChanged : Outcome::kUnchanged;
}

bool CrossingGuard::is_pinned(const AwakePair& pair, int corner) const {
  bool is_pinned = true;
  near_.each_node(pair, corner, [&](std::size_t row, int node, double) { is_pinned &= inverse_mass(row, node) == 0; });
  return is_pinned;
}

bool CrossingGuard::can_be_moved(const AwakePair& pair) const {
  for (int corner = 0; corner < 4; ++corner) {
    if (!is_pinned(pair, corner)) return true;
  }
  return false;
}

void CrossingGuard::push(const AwakePair& pair, const Eigen::Vector4d& speeds, const Eigen::Vector4d& weights,
                         double dt) {
  struct JacobianEntry {
    std::size_t row;
    int node;
    double weight;
  };
  std::array<JacobianEntry, 32> entries;
  std::size_t count = 0;
  for (int corner = 0; corner < 4; ++corner) {
    if (weights[corner] == 0) continue;
    near_.each_node(pair, corner, [&](std::size_t row, int node, double weight) {
      if (inverse_mass(row, node) == 0) return;
      const auto end = entries.begin() + count;
      const auto known = std::find_if(
          entries.begin(), end, [&](const JacobianEntry& entry) { return entry.node == node && entry.row == row; });
      if (known == end) entries[count++] = {row, node, 0};
      known->weight += weights[corner] * weight;
    });
  }
  double response = 0;  // 1/kg
  for (std::size_t i = 0; i < count; ++i) {
    response += entries[i].weight * entries[i].weight * inverse_mass(entries[i].row, entries[i].node);
  }
  if (!(response > 0)) return;
  const double approach = allowed_approach(pair, near_.brick());
  const double impulse = ((approach > 0 ? -0.5 : -2) * approach / dt - weights.dot(speeds)) / response;
  for (std::size_t i = 0; i < count; ++i) {
    const double change = impulse * entries[i].weight * inverse_mass(entries[i].row, entries[i].node);
    near_.body(entries[i].row).velocities.row(entries[i].node) += (change * pair.normal).transpose();
  }
}

void CrossingGuard::slow_nodes(const AwakePair& pair, const Eigen::Vector4d& speeds, double dt) {
  const int count = pair.pair.count;
  const bool is_first_pinned = is_pinned(pair, 0) && (count == 1 || is_pinned(pair, 1));
  const bool is_second_pinned = is_pinned(pair, 2) && is_pinned(pair, 3) && (count == 2 || is_pinned(pair, 1));
  double together = speeds.mean();
  if (is_first_pinned) together = speeds.head(count).minCoeff();
  if (is_second_pinned) together = speeds.tail(4 - count).maxCoeff();
  const double share = is_first_pinned || is_second_pinned ? 2 * kShareOfEach : kShareOfEach;
  const double most = share * std::max(0.0, allowed_approach(pair, near_.brick())) / dt;
  for (int corner = 0; corner < 4; ++corner) {
    const double sign = corner < count ? 1 : -1;
    near_.each_node(pair, corner, [&](std::size_t row, int node, double) {
      if (inverse_mass(row, node) == 0) return;
      auto velocity = near_.body(row).velocities.row(node);
      const double speed = sign * (velocity.dot(pair.normal.transpose()) - together);
      if (speed < -most) velocity -= (sign * (speed + most) * pair.normal).transpose();
    });
  }
}

std::size_t CrossingGuard::weld_of(std::size_t row, int node) {
  const auto [known, is_new] = weld_of_.try_emplace({row, node}, welds_.size());
  if (is_new) {
    const double mass = 1 / inverse_mass(row, node);
    welds_.push_back(
        {.nodes = {{row, node}}, .momentum = mass * Vec3(near_.body(row).velocities.row(node)), .mass = mass});
  }
  return known->second;
}

void CrossingGuard::weld(const AwakePair& pair) {
  std::vector<std::size_t> parts;
  Vec3 pinned_velocity = Vec3::Zero();
  int pinned = 0;
  for (int corner = 0; corner < 4; ++corner) {
    if (is_pinned(pair, corner)) {
      pinned_velocity += near_.velocity(pair, corner);
      ++pinned;
      continue;
    }
    near_.each_node(pair, corner, [&](std::size_t row, int node, double) {
      if (inverse_mass(row, node) > 0) parts.push_back(weld_of(row, node));
    });
  }
  if (parts.empty()) return;
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  Weld& all = welds_[parts.front()];
  for (std::size_t i = 1; i < parts.size(); ++i) {
    Weld& part = welds_[parts[i]];
    for (const auto& node : part.nodes) weld_of_[node] = parts.front();
    all.nodes.insert(all.nodes.end(), part.nodes.begin(), part.nodes.end());
    all.momentum += part.momentum;
    all.mass += part.mass;
    if (!all.pinned_velocity) all.pinned_velocity = part.pinned_velocity;
    part = {};
  }
  if (pinned > 0 && !all.pinned_velocity) all.pinned_velocity = pinned_velocity / pinned;
  const Vec3 velocity = all.pinned_velocity.value_or(Vec3(all.momentum / all.mass));
  for (const auto& [row, node] : all.nodes) near_.body(row).velocities.row(node) = velocity.transpose();
}

}  // namespace sprung
