#include "core/motion/implicit_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/brick_hessian.h"
#include "core/motion/stiffness_product.h"
#include "core/world/load_forces.h"

namespace sprung {
namespace {

constexpr double kSolveTolerance = 1e-4;  // of Newton's direction
constexpr double kSlip = 5e-3;            // body lengths a second that a held point may creep
constexpr int kFrictionPasses = 3;
constexpr double kSettledFriction = 0.05;  // change of a normal force that is not worth another pass, relative

Eigen::Map<const Eigen::VectorXd> flat(const Points& points) { return {points.data(), points.size()}; }

double longest_side(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

}  // namespace

ImplicitStepper::ImplicitStepper(Actor& actor, const World& world, const ImplicitOptions& options)
    : actor_(actor),
      body_(actor.body),
      world_(world),
      options_(options),
      supports_(body_.node_count()),
      size_(longest_side(body_.rest_positions)),
      stiffness_(largest_brick_stiffness(body_)),
      muscles_(actor) {
  for (const Obstacle& obstacle : world.obstacles) obstacles_.emplace_back(actor, obstacle, kSlip * size_);
}

bool ImplicitStepper::step(double elapsed, double dt) {
  const Points positions = body_.positions;
  const Points velocities = body_.velocities;
  begin(elapsed, dt);
  const bool is_found = find_minimum();
  if (!is_found) {
    body_.positions = positions;
    body_.velocities = velocities;
    has_history_ = false;
    return false;
  }
  ++steps_;
  body_.velocities = (body_.positions - origin_) / span_;
  set_held_velocities();
  before_ = positions;
  velocities_before_ = velocities;
  last_dt_ = dt;
  has_history_ = true;
  return true;
}

void ImplicitStepper::pass(MotionMemory& memory) {
  for (Points* points : {&before_, &velocities_before_}) {
    if (points->rows() == 0) points->setZero(body_.node_count(), 3);
    memory.pass(*points);
  }
  memory.pass(last_dt_);
  memory.pass_as_double(has_history_);
}

void ImplicitStepper::begin(double elapsed, double dt) {
  const bool is_second_order = options_.scheme == ImplicitScheme::kBdf2 && has_history_ && last_dt_ == dt;
  span_ = is_second_order ? 2 * dt / 3 : dt;
  origin_ = body_.positions;
  Points speed = body_.velocities;
  if (is_second_order) {
    origin_ = (4 * body_.positions - before_) / 3;
    speed = (4 * body_.velocities - velocities_before_) / 3;
  }
  const Points drift = body_.positions + dt * body_.velocities;
  goal_ = origin_ + span_ * speed;
  goal_.rowwise() += span_ * span_ * world_.gravity.transpose();
  weight_ = std::sqrt(body_.masses.squaredNorm()) * world_.gravity.norm();
  if (LoadForces acting(actor_, world_); acting.any()) {
    const Points& loads = acting.forces_beside_muscles();
    goal_ += span_ * span_ * (body_.masses.cwiseInverse().asDiagonal() * loads);
    weight_ += loads.norm();
  }
  const double alpha = body_.damping.alpha;
  mass_factor_ = 1 / (span_ * span_) + alpha / span_;
  goal_ = (goal_ / (span_ * span_) + alpha / span_ * origin_) / mass_factor_;
  terms_.mass_factor = mass_factor_;
  terms_.damping = body_.damping.beta / span_;
  terms_.damping_positions = drift;
  if (terms_.damping > 0) find_directions(body_, drift, terms_.directions);
  for (ObstaclePotential& obstacle : obstacles_) obstacle.begin(body_.positions, elapsed, dt);
  muscles_.begin();
  hold(dt);
  reach_ = body_.positions.cwiseAbs().maxCoeff();
  // Forces are those of the positions alone; damping comes from the potential.
  body_.velocities.setZero();
  const double here = evaluate();
  const Points stay = body_.positions;
  for (Eigen::Index i = 0; i < drift.size(); ++i) {
    if (!supports_.fixed[static_cast<std::size_t>(i)]) body_.positions.data()[i] = drift.data()[i];
  }
  if (!(evaluate() < here)) body_.positions = stay;
}

void ImplicitStepper::hold(double dt) {
  std::fill(supports_.fixed.begin(), supports_.fixed.end(), false);
  for (const HeldNode& held : actor_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!held.axes[static_cast<std::size_t>(axis)]) continue;
      supports_.fix(held.node, axis);
      body_.positions(held.node, axis) += dt * held.velocity[axis];
    }
  }
}

void ImplicitStepper::set_held_velocities() {
  for (const HeldNode& held : actor_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (held.axes[static_cast<std::size_t>(axis)]) body_.velocities(held.node, axis) = held.velocity[axis];
    }
  }
}

bool ImplicitStepper::find_minimum() {
  for (int pass = 0; pass < kFrictionPasses; ++pass) {
    if (!descend_to_minimum()) return false;
    bool is_settled = true;
    for (ObstaclePotential& obstacle : obstacles_) {
      const double change = obstacle.update_friction(body_.positions);
      is_settled = is_settled && change <= kSettledFriction * obstacle.largest_normal_force();
    }
    if (is_settled) return true;
  }
  return true;
}

bool ImplicitStepper::descend_to_minimum() {
  // What positions rounded to their last digit leave of forces.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * reach_ *
                          (stiffness_ + mass_factor_ * body_.masses.maxCoeff()) *
                          std::sqrt(static_cast<double>(body_.node_count()));
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
    const double potential = evaluate();
    if (!std::isfinite(potential)) return false;
    if (forces_.norm() <= std::max(options_.tolerance * work_, rounding)) return true;
    ++iterations_;
    if (!newton_step(potential)) return false;
  }
  return false;
}

double ImplicitStepper::evaluate() {
  spring_forces(body_, workspace_, forces_);
  double energy = elastic_energy(body_, workspace_);
  double work = forces_.norm() + weight_;
  energy += muscles_.add_forces(forces_);
  const Points inertia = mass_factor_ * (body_.masses.asDiagonal() * (body_.positions - goal_));
  energy += 0.5 * flat(inertia).dot(flat(Points(body_.positions - goal_)));
  work += inertia.norm();
  forces_ -= inertia;
  if (terms_.damping > 0) {
    const Points moved = body_.positions - origin_;
    Eigen::VectorXd damping;
    multiply_stiffness(body_, {.stiffness = 0, .damping = terms_.damping}, terms_.directions, flat(moved), room_,
                       damping);
    energy += 0.5 * damping.dot(flat(moved));
    work += damping.norm();
    Eigen::Map<Eigen::VectorXd>(forces_.data(), forces_.size()) -= damping;
  }
  for (ObstaclePotential& obstacle : obstacles_) energy += obstacle.add_forces(body_.positions, forces_);
  for (Eigen::Index i = 0; i < forces_.size(); ++i) {
    if (supports_.fixed[static_cast<std::size_t>(i)]) forces_.data()[i] = 0;
  }
  work_ = std::max(work, std::numeric_limits<double>::min());
  return energy;
}

bool ImplicitStepper::newton_step(double potential) {
  const Eigen::VectorXd residual = flat(forces_);
  const Eigen::VectorXd way = direction();
  if (way.size() == 0 || !way.allFinite()) return false;
  const double slope = way.dot(residual);
  // Close to the minimum the energy no longer resolves a step; a full one is then right.
  const double noise = 1e-12 * std::abs(potential) + std::numeric_limits<double>::epsilon() * work_ * size_;
  const Points start = body_.positions;
  for (double share = 1; share > 1e-6; share /= 2) {
    Eigen::Map<Eigen::VectorXd>(body_.positions.data(), body_.positions.size()) = flat(start) + share * way;
    if (evaluate() <= potential - 1e-4 * share * slope + noise) return true;
  }
  body_.positions = start;
  return false;
}

/// Newton's direction, from the true curvature where that is positive, else from its positive part.
Eigen::VectorXd ImplicitStepper::direction() {
  const Eigen::VectorXd residual = flat(forces_);
  for (const bool definite : {false, true}) {
    terms_.points.clear();
    for (ObstaclePotential& obstacle : obstacles_) obstacle.add_stiffness(body_.positions, terms_.points);
    muscles_.add_stiffness(definite, terms_.points);
    if (!system_->linearize(body_, supports_, definite, terms_)) continue;
    Eigen::VectorXd way = system_->solve(residual, kSolveTolerance);
    if (way.size() > 0 && way.allFinite()) return way;
  }
  return {};
}

}  // namespace sprung
