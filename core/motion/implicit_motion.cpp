#include "core/motion/implicit_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/body/brick_hessian.h"
#include "core/body/forces.h"
#include "core/motion/diverged.h"
#include "core/motion/ground_potential.h"
#include "core/motion/stiffness_product.h"
#include "core/motion/why_not_implicit.h"

namespace sprung {
namespace {

constexpr double kSolveTolerance = 1e-4;  // of Newton's direction
constexpr double kSlip = 5e-3;            // body lengths a second that a held point may creep
constexpr int kFrictionPasses = 3;
constexpr double kSettledFriction = 0.05;  // change of a normal force that is not worth another pass, relative
constexpr int kMostHalvings = 8;

Eigen::Map<const Eigen::VectorXd> flat(const Points& points) { return {points.data(), points.size()}; }

double longest_side(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

}  // namespace

/// One actor.
class ImplicitMotion::Stepper {
 public:
  Stepper(Actor& actor, const World& world, const ImplicitOptions& options)
      : actor_(actor),
        body_(actor.body),
        world_(world),
        options_(options),
        supports_(body_.node_count()),
        size_(longest_side(body_.rest_positions)),
        stiffness_(largest_brick_stiffness(body_)) {
    const Obstacle* ground = highest_ground(world.obstacles);
    if (ground != nullptr) ground_.emplace(actor, ground->pose.translation.y(), ground->friction, kSlip * size_);
  }

  /// False where no minimum was found; the body is then as before.
  bool step(double dt) {
    const Points positions = body_.positions;
    const Points velocities = body_.velocities;
    begin(dt);
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

  void pass(MotionMemory& memory) {
    for (Points* points : {&before_, &velocities_before_}) {
      if (points->rows() == 0) points->setZero(body_.node_count(), 3);
      memory.pass(*points);
    }
    memory.pass(last_dt_);
    memory.pass_as_double(has_history_);
  }

  [[nodiscard]] SolveReport solves() const { return system_->report(); }
  [[nodiscard]] long steps() const { return steps_; }
  [[nodiscard]] long iterations() const { return iterations_; }

 private:
  void begin(double dt);
  void hold(double dt);
  void set_held_velocities();
  bool find_minimum();
  bool descend_to_minimum();
  /// The potential (J) at the positions; the forces on free degrees of freedom into forces_.
  double evaluate();
  bool newton_step(double potential);
  [[nodiscard]] Eigen::VectorXd direction();

  Actor& actor_;
  Body& body_;
  const World& world_;
  const ImplicitOptions& options_;
  Supports supports_;
  double size_;       // m
  double stiffness_;  // N/m, the largest of a brick
  double reach_ = 0;  // m, from the origin
  std::optional<GroundPotential> ground_;
  std::unique_ptr<NewtonSystem> system_ = make_quick_system();
  StepTerms terms_;

  // of the step at hand
  double span_ = 0;         // s
  Points origin_;           // x0
  Points goal_;             // where inertia and gravity alone lead
  double mass_factor_ = 0;  // 1/s^2

  bool has_history_ = false;
  double last_dt_ = 0;
  Points before_;
  Points velocities_before_;

  ForceWorkspace workspace_;
  std::vector<double> room_;
  Points forces_;
  double work_ = 0;  // size of the forces at work, N
  long steps_ = 0;
  long iterations_ = 0;
};

void ImplicitMotion::Stepper::begin(double dt) {
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
  const double alpha = body_.damping.alpha;
  mass_factor_ = 1 / (span_ * span_) + alpha / span_;
  goal_ = (goal_ / (span_ * span_) + alpha / span_ * origin_) / mass_factor_;
  terms_.mass_factor = mass_factor_;
  terms_.damping = body_.damping.beta / span_;
  terms_.damping_positions = drift;
  if (ground_) ground_->begin(body_.positions, dt);
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

void ImplicitMotion::Stepper::hold(double dt) {
  std::fill(supports_.fixed.begin(), supports_.fixed.end(), false);
  for (const HeldNode& held : actor_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!held.axes[static_cast<std::size_t>(axis)]) continue;
      supports_.fix(held.node, axis);
      body_.positions(held.node, axis) += dt * held.velocity[axis];
    }
  }
}

void ImplicitMotion::Stepper::set_held_velocities() {
  for (const HeldNode& held : actor_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (held.axes[static_cast<std::size_t>(axis)]) body_.velocities(held.node, axis) = held.velocity[axis];
    }
  }
}

bool ImplicitMotion::Stepper::find_minimum() {
  for (int pass = 0; pass < kFrictionPasses; ++pass) {
    if (!descend_to_minimum()) return false;
    if (!ground_) return true;
    const double change = ground_->update_friction(body_.positions);
    if (change <= kSettledFriction * ground_->largest_normal_force()) return true;
  }
  return true;
}

bool ImplicitMotion::Stepper::descend_to_minimum() {
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

double ImplicitMotion::Stepper::evaluate() {
  spring_forces(body_, workspace_, forces_);
  double energy = elastic_energy(body_, workspace_);
  double work = forces_.norm() + std::sqrt(body_.masses.squaredNorm()) * world_.gravity.norm();
  const Points inertia = mass_factor_ * (body_.masses.asDiagonal() * (body_.positions - goal_));
  energy += 0.5 * flat(inertia).dot(flat(Points(body_.positions - goal_)));
  work += inertia.norm();
  forces_ -= inertia;
  if (terms_.damping > 0) {
    const Points moved = body_.positions - origin_;
    Eigen::VectorXd damping;
    multiply_stiffness(body_, {.stiffness = 0, .damping = terms_.damping}, terms_.damping_positions, flat(moved), room_,
                       damping);
    energy += 0.5 * damping.dot(flat(moved));
    work += damping.norm();
    Eigen::Map<Eigen::VectorXd>(forces_.data(), forces_.size()) -= damping;
  }
  if (ground_) energy += ground_->add_forces(body_.positions, forces_);
  for (Eigen::Index i = 0; i < forces_.size(); ++i) {
    if (supports_.fixed[static_cast<std::size_t>(i)]) forces_.data()[i] = 0;
  }
  work_ = std::max(work, std::numeric_limits<double>::min());
  return energy;
}

bool ImplicitMotion::Stepper::newton_step(double potential) {
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
Eigen::VectorXd ImplicitMotion::Stepper::direction() {
  const Eigen::VectorXd residual = flat(forces_);
  terms_.points.clear();
  if (ground_) ground_->add_stiffness(body_.positions, terms_.points);
  for (const bool definite : {false, true}) {
    if (!system_->linearize(body_, supports_, definite, terms_)) continue;
    Eigen::VectorXd way = system_->solve(residual, kSolveTolerance);
    if (way.size() > 0 && way.allFinite()) return way;
  }
  return {};
}

ImplicitMotion::ImplicitMotion(World& world, const ImplicitOptions& options) : options_(options) {
  const std::string why_not = why_not_implicit(world);
  if (!why_not.empty()) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}, which implicit steps know nothing of: use an explicit scheme, euler or verlet", why_not));
  }
  for (Actor& actor : world.actors) steppers_.push_back(std::make_unique<Stepper>(actor, world, options_));
}

ImplicitMotion::~ImplicitMotion() = default;

void ImplicitMotion::advance(double dt, long steps, double time) {
  for (std::size_t actor = 0; actor < steppers_.size(); ++actor) {
    // In units of the shortest step: a step that is not found is cut in halves.
    for (long step = 0; step < steps; ++step) {
      double done = 0;
      double stride = 1;
      int halvings = 0;
      while (done < 1) {
        if (steppers_[actor]->step(stride * dt)) {
          done += stride;
          continue;
        }
        ++halvings_;
        stride /= 2;
        if (++halvings > kMostHalvings) {
          throw Diverged(
              actor, fmt::format("body {}: no step of {:.3g} s leads on from t = {:.6g} s; use more bricks, a stiffer "
                                 "material or a shorter fall",
                                 actor + 1, stride * dt, time + dt * (static_cast<double>(step) + done)));
        }
      }
    }
  }
}

void ImplicitMotion::pass(MotionMemory& memory) {
  for (const auto& stepper : steppers_) stepper->pass(memory);
}

ImplicitMotion::Report ImplicitMotion::report() const {
  Report report;
  report.halvings = halvings_;
  for (const auto& stepper : steppers_) {
    const SolveReport solves = stepper->solves();
    report.solves.solves += solves.solves;
    report.solves.iterations += solves.iterations;
    report.solves.most = std::max(report.solves.most, solves.most);
    report.solves.indefinite += solves.indefinite;
    report.solves.gone_direct += solves.gone_direct;
    report.steps += stepper->steps();
    report.newton_iterations += stepper->iterations();
  }
  return report;
}

}  // namespace sprung
