#include "core/contact/pairs/near_features.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/contact/search/obstacle_surface.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kMaxStepsAhead = 8;  // that are predicted ...
constexpr double kWayAhead = 0.02;    // ... or fewer, in which nothing moves by more than so many bricks ...
constexpr double kMinStepsAhead = 2;  // ... this one and the next, whose contacts this prediction gives
constexpr double kSlack = 0.004;      // bricks that nodes may deviate from where their velocities take them ...
constexpr double kMoreSlack = 4;      // times as far, each time that a step is checked again ...
constexpr int kMaxGrowths = 3;        // ... so often: with more, all of a body would be near itself
constexpr double kMaxMove = 2;        // bricks in a step, against the mean of the body: with more, likewise

/// The bricks of bodies `a` and `b` that are glued together, each pair once.
FeaturePairs::Joints joints_between(const std::vector<GluedPoint>& glue, std::size_t a, std::size_t b) {
  FeaturePairs::Joints joints;
  for (const GluedPoint& point : glue) {
    if (point.bodies == std::array{a, b}) joints.push_back(point.bricks);
    if (point.bodies == std::array{b, a}) joints.push_back({point.bricks[1], point.bricks[0]});
  }
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

}  // namespace

NearFeatures::NearFeatures(const Group& group, const World& world, const std::vector<GluedPoint>& glue,
                           Surfaces surfaces)
    : group_(group), brick_(smallest_brick(group)), surfaces_(std::move(surfaces)) {
  each_tree([](SurfaceTree& tree) { tree.begin(); });
  std::vector<std::size_t> smooth;
  for (std::size_t row = 0; row < world.obstacles.size(); ++row) {
    const Shape& shape = world.obstacles[row].shape;
    shapes_.push_back(shape);
    (has_edges(shape) ? obstacle_rows_ : smooth).push_back(row);
  }
  if (surfaces_.trees.empty()) make_surfaces(world, !smooth.empty());
  const Trees& trees = surfaces_.trees;
  const Trees& outlines = surfaces_.outlines;
  std::vector<std::array<std::size_t, 2>> rows;
  const auto add = [&](std::size_t a, std::size_t b, double friction) {
    rows.push_back({a, b});
    pairs_.push_back(
        std::make_unique<FeaturePairs>(*trees[a], *trees[b], std::array{a, b}, friction, joints_between(glue, a, b)));
  };
  for (std::size_t a = 0; a < group_.size(); ++a) {
    std::vector<Against>& against = against_.emplace_back();
    for (const std::size_t row : smooth) against.push_back({.obstacle = row, .pairs = ShapePairs(*outlines[a], a)});
    if (group_[a]->contact.with_itself) add(a, a, group_[a]->contact.friction);
    for (std::size_t b = a + 1; b < group_.size() && world.bodies_collide; ++b) {
      add(a, b, std::sqrt(group_[a]->contact.friction * group_[b]->contact.friction));
    }
    for (std::size_t i = 0; i < obstacle_rows_.size(); ++i) {
      add(a, group_.size() + i, world.obstacles[obstacle_rows_[i]].friction);
    }
  }
  arrange_rounds(rows);
}

void NearFeatures::arrange_rounds(const std::vector<std::array<std::size_t, 2>>& surfaces) {
  std::vector<std::vector<char>> is_taken;  // by round and surface
  for (std::size_t row = 0; row < surfaces.size(); ++row) {
    const auto& [a, b] = surfaces[row];
    std::size_t round = 0;
    while (round < rounds_.size() && (is_taken[round][a] || is_taken[round][b])) ++round;
    if (round == rounds_.size()) {
      rounds_.emplace_back();
      is_taken.emplace_back(surfaces_.trees.size(), false);
    }
    rounds_[round].push_back(row);
    is_taken[round][a] = is_taken[round][b] = true;
  }
}

void NearFeatures::make_surfaces(const World& world, bool with_outlines) {
  for (const std::size_t row : obstacle_rows_) {
    surfaces_.obstacles.push_back(std::make_unique<SoftBody>(obstacle_surface(world.obstacles[row], brick_)));
  }
  for (std::size_t row = 0; row < group_.size() + obstacle_rows_.size(); ++row) {
    surfaces_.trees.push_back(std::make_unique<SurfaceTree>(contact_surface_of(body(row)), body(row)));
  }
  for (std::size_t row = 0; row < group_.size() && with_outlines; ++row) {
    surfaces_.outlines.push_back(std::make_unique<SurfaceTree>(outline_of(body(row)), body(row)));
  }
}

bool NearFeatures::is_of_surfaces(const World& world) const {
  for (std::size_t row = 0; row < group_.size(); ++row) {
    const ContactSkin& contact = group_[row]->contact;
    if (contact.surface.get() != &surfaces_.trees[row]->skin()) return false;
    if (!surfaces_.outlines.empty() && contact.outline.get() != &surfaces_.outlines[row]->skin()) return false;
  }
  return std::equal(shapes_.begin(), shapes_.end(), world.obstacles.begin(), world.obstacles.end(),
                    [](const Shape& shape, const Obstacle& obstacle) { return shape == obstacle.shape; });
}

SoftBody& NearFeatures::body(std::size_t row) const {
  return row < group_.size() ? *group_[row] : *surfaces_.obstacles[row - group_.size()];
}

Vec3 NearFeatures::known_velocity(const AwakePair& pair, int corner) {
  if (pair.body_of(corner) == AwakePair::kNoBody) return pair.obstacle_velocity;
  return tree_of(pair, corner).velocity_of(pair.pair.corners[corner]);
}

Vec3 NearFeatures::velocity(const AwakePair& pair, int corner) const {
  const std::size_t row = pair.body_of(corner);
  if (row == AwakePair::kNoBody) return pair.obstacle_velocity;
  return carried(body(row), point_of(pair, corner), body(row).velocities);
}

int NearFeatures::nearest_node(const AwakePair& pair) const {
  const ContactPoint& point = point_of(pair, 0);
  return body(pair.body_of(0)).grid.nodes[point.brick][point.corner];
}

void NearFeatures::refresh_velocities() {
  each_tree([](SurfaceTree& tree) { tree.refresh_velocities(); });
}

void NearFeatures::begin_step(const World& world, double elapsed, double dt) {
  rechecks_ = 0;
  poses_.clear();
  for (const Obstacle& obstacle : world.obstacles) poses_.push_back(pose_after(obstacle, elapsed));
  for (std::size_t i = 0; i < surfaces_.obstacles.size(); ++i) {
    move_surface(world.obstacles[obstacle_rows_[i]], elapsed, dt, *surfaces_.obstacles[i]);
  }
  each_tree([](SurfaceTree& tree) { tree.refresh(); });
  if (seen_.empty()) predict(world, dt, kSlack);
  measure(world);
}

bool NearFeatures::recheck(const World& world, double dt) {
  if (deviation(dt) <= slack_) return false;
  predict(world, dt, kSlack * std::pow(kMoreSlack, std::min(rechecks_++, kMaxGrowths)));
  measure(world);
  return true;
}

double NearFeatures::deviation(double dt) const {
  if (seen_.empty() || since_look_ + dt > horizon_ * (1 + 1e-9)) return std::numeric_limits<double>::infinity();
  const Trees& trees = surfaces_.trees;
  const Trees& outlines = surfaces_.outlines;
  double furthest = 0;
  for (std::size_t row = 0; row < seen_.size(); ++row) {
    const Body& now = body(row);
    const Seen& seen = seen_[row];
    const auto off = now.positions + dt * now.velocities - seen.positions - (since_look_ + dt) * seen.velocities;
    double spread = trees[row]->spread();
    if (row < outlines.size()) spread = std::max(spread, outlines[row]->spread());
    furthest = std::max(furthest, spread * std::sqrt(off.rowwise().squaredNorm().maxCoeff()));
  }
  return furthest / brick_;
}

void NearFeatures::throw_runaway(const World& world, std::size_t row, double way) const {
  const auto found =
      std::find_if(world.bodies.begin(), world.bodies.end(), [&](const SoftBody& one) { return &one == group_[row]; });
  const std::size_t number = std::size_t(found - world.bodies.begin());
  throw Diverged(number, fmt::format("a part of body {} moves by {:.2g} bricks against the rest in a time step",
                                     number + 1, way / brick_));
}

void NearFeatures::predict(const World& world, double dt, double slack) {
  double fastest = 0;
  for (std::size_t row = 0; row < surfaces_.trees.size(); ++row) {
    const double speed = surfaces_.trees[row]->fastest();
    fastest = std::max(fastest, speed);
    if (row >= group_.size() || pairs_.empty()) continue;
    if (!(speed * dt <= kMaxMove * brick_)) throw_runaway(world, row, speed * dt);  // nor if it is not finite
  }
  const double steps = std::floor(kWayAhead * brick_ / (2 * fastest * dt));
  horizon_ = dt * std::clamp(steps, kMinStepsAhead, kMaxStepsAhead);
  slack_ = slack;
  since_look_ = 0;
  seen_.resize(surfaces_.trees.size());
  tbb::parallel_for(std::size_t{0}, surfaces_.trees.size(), [&](std::size_t row) {
    seen_[row] = {body(row).positions, body(row).velocities};
    surfaces_.trees[row]->follow(horizon_, slack_ * brick_);
    if (row < surfaces_.outlines.size()) surfaces_.outlines[row]->follow(horizon_, slack_ * brick_);
  });
  for (const std::vector<std::size_t>& round : rounds_) {
    tbb::parallel_for(std::size_t{0}, round.size(), [&](std::size_t i) { pairs_[round[i]]->wake(); });
  }
  tbb::parallel_for(std::size_t{0}, against_.size(), [&](std::size_t row) {
    for (Against& against : against_[row]) {
      against.pairs.wake(world.obstacles[against.obstacle], poses_[against.obstacle], horizon_);
    }
  });
}

void NearFeatures::measure(const World& world) {
  awake_.clear();
  for (std::vector<Against>& of_body : against_) {
    for (Against& against : of_body) {
      against.pairs.measure(world.obstacles[against.obstacle], poses_[against.obstacle], awake_);
    }
  }
  for (const auto& pairs : pairs_) pairs->measure(awake_);
  are_entangled_.assign(awake_.size(), std::nullopt);
}

bool NearFeatures::is_entangled(std::size_t row) {
  const AwakePair& pair = awake_[row];
  if (pair.bodies[1] == AwakePair::kNoBody || pair.bodies[0] == pair.bodies[1]) return false;
  std::optional<bool>& is_known = are_entangled_[row];
  for (int corner = 0; corner < 4 && !is_known; ++corner) {
    SurfaceTree& other = *surfaces_.trees[pair.bodies[1 - pair.pair.side(corner)]];
    if (other.encloses(tree_of(pair, corner).position_of(pair.pair.corners[corner]))) is_known = true;
  }
  if (!is_known) is_known = false;
  return *is_known;
}

}  // namespace sprung
