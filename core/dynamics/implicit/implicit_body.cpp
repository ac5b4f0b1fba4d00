#include "core/dynamics/implicit/implicit_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/brick_hessian.h"
#include "core/bricks/brick_topology.h"
#include "core/world/load_forces.h"

namespace sprung {

void MusclePotential::begin() {
  tensions_.clear();
  for (const Muscle& muscle : body_.loads.muscles) tensions_.push_back(tension_of(muscle, body_.model, body_.material));
}

template <class Visit>
void MusclePotential::for_draws(const Visit& visit) const {
  const double h = body_.grid.brick_size;
  for (std::size_t m = 0; m < tensions_.size(); ++m) {
    const MuscleTension& tension = tensions_[m];
    Eigen::Matrix<double, 8, 3> weights;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 sides;
      for (int axis = 0; axis < 3; ++axis) sides[axis] = on_high_side(corner, axis) ? 1 : -1;
      weights.row(corner) = sides.transpose() * tension.frame / (4 * h);
    }
    for (const int brick : body_.loads.muscles[m].bricks) {
      const std::size_t b = brick;
      const double volume = body_.stiffness_scale[b] * body_.grid.brick_volume();
      for (int i = 0; i < 3; ++i) {
        Draw draw{
            .brick = brick, .weights = weights.col(i), .along = Vec3::Zero(), .energy = volume * tension.stress[i]};
        for (std::size_t c = 0; c < 8; ++c) {
          draw.along += draw.weights[c] * body_.positions.row(body_.grid.nodes[b][c]).transpose();
        }
        visit(draw);
      }
    }
  }
}

double MusclePotential::add_forces(Points& forces) const {
  double energy = 0;
  for_draws([&](const Draw& draw) {
    const double length = draw.along.norm();
    energy += draw.energy * length;
    const Vec3 pull = draw.energy / length * draw.along;
    const auto& nodes = body_.grid.nodes[draw.brick];
    for (std::size_t c = 0; c < 8; ++c) forces.row(nodes[c]) -= draw.weights[c] * pull.transpose();
  });
  return energy;
}

void MusclePotential::add_stiffness(bool definite, std::vector<PointStiffness>& points) const {
  for_draws([&](const Draw& draw) {
    if (definite && draw.energy < 0) return;
    const double length = draw.along.norm();
    const Vec3 way = draw.along / length;
    points.push_back({.brick = draw.brick,
                      .weights = draw.weights,
                      .stiffness = draw.energy / length * (Mat3::Identity() - way * way.transpose())});
  });
}

namespace {

constexpr double kSlip = 5e-3;  // body lengths per second that a sticking point may creep

Eigen::Map<const Eigen::VectorXd> flat(const Points& points) { return {points.data(), points.size()}; }

double longest_side(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

}  // namespace

ImplicitBody::ImplicitBody(SoftBody& body, const World& world, const ImplicitOptions& options)
    : body_(body),
      world_(world),
      options_(options),
      supports_(body_.node_count()),
      size_(longest_side(body_.rest_positions)),
      slip_speed_(kSlip * size_),
      stiffness_(largest_brick_stiffness(body_)),
      muscles_(body) {
  for (const Obstacle& obstacle : world.obstacles) obstacles_.emplace_back(body, obstacle, slip_speed_);
  history_.penetrations.setZero(contact_surface_of(body).points.size());
}

void ImplicitBody::serialize(IntegratorState& state) {
  for (Points* points : {&history_.positions, &history_.velocities}) {
    if (points->rows() == 0) points->setZero(body_.node_count(), 3);
    state.serialize(*points);
  }
  for (double& depth : history_.penetrations) state.serialize(depth);
  state.serialize(history_.last_dt);
  state.serialize_as_double(history_.is_there);
}

void ImplicitBody::begin(double elapsed, double dt) {
  positions_ = body_.positions;
  velocities_ = body_.velocities;
  before_ = history_;
  aim(dt);
  for (ObstaclePotential& obstacle : obstacles_) obstacle.begin(body_.positions, elapsed, dt);
  muscles_.begin();
  hold(elapsed, dt);
  pinned_start_ = body_.positions;
  reach_ = pinned_start_.cwiseAbs().maxCoeff();
  body_.velocities.setZero();
}

void ImplicitBody::aim(double dt) {
  const bool is_second_order = options_.scheme == ImplicitScheme::kBdf2 && history_.is_there && history_.last_dt == dt;
  span_ = is_second_order ? 2 * dt / 3 : dt;
  origin_ = positions_;
  Points speed = velocities_;
  if (is_second_order) {
    origin_ = (4 * positions_ - history_.positions) / 3;
    speed = (4 * velocities_ - history_.velocities) / 3;
  }
  goal_ = origin_ + span_ * speed;
  goal_.rowwise() += span_ * span_ * world_.gravity.transpose();
  weight_ = std::sqrt(body_.masses.squaredNorm()) * world_.gravity.norm();
  if (LoadForces acting(body_, world_); acting.any()) {
    const Points& loads = acting.forces_beside_muscles();
    goal_ += span_ * span_ * (body_.masses.cwiseInverse().asDiagonal() * loads);
    weight_ += loads.norm();
  }
  const double alpha = body_.damping.alpha;
  mass_factor_ = 1 / (span_ * span_) + alpha / span_;
  goal_ = (goal_ / (span_ * span_) + alpha / span_ * origin_) / mass_factor_;
  terms_.mass_factor = mass_factor_;
  terms_.damping = body_.damping.beta / span_;
  terms_.damping_positions = positions_ + dt * velocities_;
}

void ImplicitBody::hold(double elapsed, double dt) {
  std::fill(supports_.fixed.begin(), supports_.fixed.end(), false);
  for (const KinematicNode& pinned : body_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!pinned.axes[axis]) continue;
      supports_.fix(pinned.node, axis);
      body_.positions(pinned.node, axis) += dt * pinned.velocity[axis];
    }
  }
  supports_.springs = body_.supports_after(elapsed + dt);
  support_stiffness_ = 0;
  for (const SpringSupport& support : supports_.springs) {
    support_stiffness_ = std::max(support_stiffness_, support.spring.stiffness.trace());
  }
}

void ImplicitBody::drift() {
  for (Eigen::Index i = 0; i < pinned_start_.size(); ++i) {
    if (supports_.fixed[i]) continue;
    body_.positions.data()[i] = terms_.damping_positions.data()[i];
  }
}

void ImplicitBody::stay() { body_.positions = pinned_start_; }

void ImplicitBody::finish(double dt) {
  body_.velocities = (body_.positions - origin_) / span_;
  for (const KinematicNode& pinned : body_.pinned) {
    for (int axis = 0; axis < 3; ++axis) {
      if (pinned.axes[axis]) body_.velocities(pinned.node, axis) = pinned.velocity[axis];
    }
  }
  history_ = {.is_there = true,
              .last_dt = dt,
              .positions = positions_,
              .velocities = velocities_,
              .penetrations = history_.penetrations};
}

void ImplicitBody::undo() {
  body_.positions = positions_;
  body_.velocities = velocities_;
  history_ = before_;
}

double ImplicitBody::evaluate() {
  spring_forces(body_, workspace_, forces_);
  double energy = elastic_energy(body_, workspace_);
  energy += muscles_.add_forces(forces_);
  if (!supports_.springs.empty()) {
    const Points displacements = body_.positions - body_.rest_positions;
    energy += support_energy(supports_.springs, body_, displacements);
    forces_ += support_forces(supports_.springs, body_, displacements);
  }
  work_ = forces_.norm() + weight_;
  const Points inertia = mass_factor_ * (body_.masses.asDiagonal() * (body_.positions - goal_));
  energy += 0.5 * flat(inertia).dot(flat(Points(body_.positions - goal_)));
  work_ += inertia.norm();
  forces_ -= inertia;
  if (terms_.damping > 0) {
    const Points moved = body_.positions - origin_;
    Eigen::VectorXd damping;
    multiply_damping(body_, terms_.damping_positions, terms_.damping, flat(moved), products_, damping);
    energy += 0.5 * damping.dot(flat(moved));
    work_ += damping.norm();
    Eigen::Map<Eigen::VectorXd>(forces_.data(), forces_.size()) -= damping;
  }
  for (ObstaclePotential& obstacle : obstacles_) energy += obstacle.add_forces(body_.positions, forces_);
  work_ = std::max(work_, std::numeric_limits<double>::min());
  return energy;
}

void ImplicitBody::release_held() {
  for (Eigen::Index i = 0; i < forces_.size(); ++i) {
    if (supports_.fixed[i]) forces_.data()[i] = 0;
  }
}

bool ImplicitBody::has_converged() const {
  // The forces due to positions rounded to their last digit.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * reach_ *
                          (std::max(stiffness_, support_stiffness_) + mass_factor_ * body_.masses.maxCoeff()) *
                          std::sqrt(body_.node_count());
  return forces_.norm() <= std::max(options_.tolerance * work_, rounding);
}

double ImplicitBody::noise() const {
  return std::numeric_limits<double>::epsilon() * work_ * size_ + energy_rounding(body_);
}

bool ImplicitBody::settle_friction() {
  bool is_settled = true;
  for (ObstaclePotential& obstacle : obstacles_) {
    const double change = obstacle.update_friction(body_.positions);
    is_settled = is_settled && change <= kSettledFriction * obstacle.largest_normal_force();
  }
  return is_settled;
}

void ImplicitBody::take_terms(bool definite) {
  terms_.points = support_terms(supports_).points;
  for (ObstaclePotential& obstacle : obstacles_) obstacle.add_stiffness(body_.positions, terms_.points);
  muscles_.add_stiffness(definite, terms_.points);
}

bool ImplicitBody::linearize(bool definite) {
  take_terms(definite);
  return alone_->linearize(body_, supports_, definite, terms_);
}

bool ImplicitBody::linearize(bool definite, std::vector<PointStiffness> coupled) {
  take_terms(definite);
  terms_.coupled = std::move(coupled);
  return coupled_->linearize(body_, supports_, definite, terms_);
}

Eigen::VectorXd ImplicitBody::solve(double tolerance) { return alone_->solve(flat(forces_), tolerance); }

}  // namespace sprung
