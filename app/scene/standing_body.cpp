#include "app/scene/standing_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/dynamics/explicit/integrator.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kOverload = 2;             // times the weight, which must not buckle it:
constexpr double kOverloadResponse = 3;     // times the displacement, at most
constexpr double kKeptMargin = 0.6;         // of the distance from the centre of mass to the edge of the feet
constexpr double kHopeless = 1.5;           // times the displacement allowed: not worth going on
constexpr double kStandingFraction = 0.04;  // of the height, as round bodies flatten, ...
constexpr double kHangingFraction = 0.08;   // ... or as the scenario pins, ...
constexpr double kSupportedBricks = 0.5;    // ... but at least so many bricks: these may be askew
constexpr double kFill = 0.25;              // a brick is taken to be at least that full

// Sags are told to a thousandth; what does not converge quickly is near buckling.
const StaticOptions kQuick{.tolerance = 1e-3, .direction_tolerance = 1e-2, .max_iterations = 20, .max_load_steps = 1};

Body standing_body(BrickGrid grid, Model model, const Material& material) {
  Body body = make_body(std::move(grid), model, material);
  // Hardly filled bricks would sag by themselves.
  for (double& scale : body.stiffness_scale) scale = std::max(scale, kFill);
  build_tiles(body);
  return body;
}

/// The largest displacement of a node of a solid, m.
double displacement_of(const Body& body) { return (body.positions - body.rest_positions).rowwise().norm().maxCoeff(); }

/// The lowest part of a body, or the highest. `down`: in its frame.
Supports supports_at_end(const Body& body, Support support, const Vec3& down) {
  const Eigen::VectorXd heights = body.rest_positions * -down.normalized();
  const double low = heights.minCoeff();
  const double high = heights.maxCoeff();
  const double fraction = support == Support::kStands ? kStandingFraction : kHangingFraction;
  const double part = std::max(fraction * (high - low), kSupportedBricks * body.grid.brick_size);
  Supports supports(body.node_count());
  for (int node = 0; node < body.node_count(); ++node) {
    const bool is_supported = support == Support::kStands ? heights[node] <= low + part : heights[node] >= high - part;
    for (int axis = 0; is_supported && axis < 3; ++axis) supports.fix(node, axis);
  }
  return supports;
}

Supports supports_by_pins(const Body& body, std::size_t solid, const std::vector<Pin>& pins, const Selector& selector) {
  Supports supports(body.node_count());
  for (const Pin& pin : pins) {
    for (const int node : selector.nodes(pin, body.rest_positions, solid)) {
      for (int axis = 0; axis < 3; ++axis) {
        if (pin.axes.fixed[axis]) supports.fix(node, axis);
      }
    }
  }
  return supports;
}

}  // namespace

StandingBody::StandingBody(std::vector<BrickGrid> solids, Model model, const Material& material, Support support,
                           const std::vector<Pin>& pins, const Selector& selector, const Vec3& gravity)
    : support_(support), gravity_(gravity) {
  for (std::size_t row = 0; row < solids.size(); ++row) {
    const Body& body = solids_.emplace_back(standing_body(std::move(solids[row]), model, material));
    supports_.push_back(support == Support::kPins ? supports_by_pins(body, row, pins, selector)
                                                  : supports_at_end(body, support, gravity));
    systems_.push_back(make_default_solver());
  }
}

std::optional<double> StandingBody::linear_displacement() {
  return displaced([this](std::size_t row) {
    Body& body = solids_[row];
    const Points still = Points::Zero(body.node_count(), 3);
    body.positions += linear_response(body, supports_[row], load(row, 1), still, *systems_[row]).displacements;
  });
}

double StandingBody::stable_step() {
  double shortest = std::numeric_limits<double>::infinity();
  rest();
  for (const Body& body : solids_) shortest = std::min(shortest, sprung::stable_step(body));
  return shortest;
}

std::optional<double> StandingBody::carried_displacement(double weight, double most) {
  rest();
  const std::optional<double> once = displacement(weight, most);
  if (!once) return std::nullopt;
  if (support_ == Support::kStands && solids_.size() == 1) {
    const Body& body = solids_[0];
    if (margin(body, body.positions) < kKeptMargin * margin(body, body.rest_positions)) return std::nullopt;
  }
  return displacement(kOverload * weight, kOverloadResponse * *once) ? once : std::nullopt;
}

Points StandingBody::load(std::size_t row, double weight) const {
  return weight * solids_[row].masses * gravity_.transpose();
}

void StandingBody::rest() {
  for (Body& body : solids_) body.positions = body.rest_positions;
}

std::optional<double> StandingBody::displaced(const std::function<void(std::size_t)>& move) {
  double largest = 0;
  for (std::size_t row = 0; row < solids_.size(); ++row) {
    try {
      move(row);
    } catch (const Error&) {
      return std::nullopt;
    }
    largest = std::max(largest, displacement_of(solids_[row]));
  }
  return largest;
}

std::optional<double> StandingBody::displacement(double weight, double most) {
  const std::optional<double> largest = displaced([&](std::size_t row) {
    Body& body = solids_[row];
    StaticOptions options = kQuick;
    options.between = [&] {
      if (displacement_of(body) > kHopeless * most) throw Error(ErrorKind::kFailed, "sags too far");
    };
    const Points start = body.positions;
    solve_static(body, supports_[row], load(row, weight), start, *systems_[row], options);
  });
  return largest && *largest <= most ? largest : std::nullopt;
}

double StandingBody::margin(const Body& body, const Points& positions) const {
  constexpr int kDirections = 32;
  const Vec3 centre = positions.transpose() * body.masses / body.masses.sum();
  const Vec3 u = gravity_.unitOrthogonal();
  const Vec3 v = gravity_.normalized().cross(u);
  double nearest = std::numeric_limits<double>::max();
  for (int k = 0; k < kDirections; ++k) {
    const double turn = 2 * std::numbers::pi * k / kDirections;
    const Vec3 outwards = std::cos(turn) * u + std::sin(turn) * v;
    double farthest = std::numeric_limits<double>::lowest();
    for (int node = 0; node < body.node_count(); ++node) {
      if (!supports_[0].fixed[3 * std::size_t(node)]) continue;
      farthest = std::max(farthest, outwards.dot(positions.row(node).transpose() - centre));
    }
    nearest = std::min(nearest, farthest);
  }
  return nearest;
}

}  // namespace sprung
