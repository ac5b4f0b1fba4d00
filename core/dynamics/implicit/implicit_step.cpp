#include "core/dynamics/implicit/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/implicit/coupling.h"

namespace sprung {
namespace {

constexpr double kSolveTolerance = 1e-4;  // of Newton's direction
constexpr int kFrictionPasses = 3;
constexpr int kRefreshes = 12;  // of the contact pairs in a descent, so that it terminates

/// The smallest of the bodies'.
double slip_of(const std::vector<ImplicitBody*>& bodies, double dt) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const ImplicitBody* body : bodies) slowest = std::min(slowest, body->slip_speed());
  return slowest * dt;
}

std::vector<Eigen::VectorXd*> pushed_in_of(const std::vector<ImplicitBody*>& bodies) {
  std::vector<Eigen::VectorXd*> penetrations;
  penetrations.reserve(bodies.size());
  for (ImplicitBody* body : bodies) penetrations.push_back(&body->penetrations());
  return penetrations;
}

}  // namespace

ImplicitStep::ImplicitStep(const World& world, std::vector<ImplicitBody*> bodies, const Group& group,
                           const std::vector<GluedPoint>& glue, const ImplicitOptions& options, double dt)
    : bodies_(std::move(bodies)),
      pushed_in_(pushed_in_of(bodies_)),
      options_(options),
      dt_(dt),
      skins_(world, group, glue, {.dt = dt, .slip = slip_of(bodies_, dt)}, pushed_in_) {
  for (ImplicitBody* body : bodies_) forces_.push_back(&body->forces());
}

bool ImplicitStep::make(double elapsed, ImplicitCounts& counts) {
  begin(elapsed);
  const bool has_converged = find_minimum(counts);
  if (has_converged) ++counts.steps;
  for (ImplicitBody* body : bodies_) {
    if (has_converged) {
      body->finish(dt_);
    } else {
      body->undo();
    }
  }
  if (has_converged) skins_.remember(pushed_in_);
  return has_converged;
}

void ImplicitStep::begin(double elapsed) {
  for (ImplicitBody* body : bodies_) body->begin(elapsed, dt_);
  const double here = evaluate();
  for (ImplicitBody* body : bodies_) body->drift();
  if (evaluate() < here) return;
  for (ImplicitBody* body : bodies_) body->stay();
}

bool ImplicitStep::find_minimum(ImplicitCounts& counts) {
  for (int pass = 0; pass < kFrictionPasses; ++pass) {
    if (!descend_to_minimum(counts)) return false;
    if (settle_friction()) return true;
  }
  return true;
}

bool ImplicitStep::settle_friction() {
  bool is_settled = skins_.update_friction() <= kSettledFriction * skins_.largest_normal_force();
  for (ImplicitBody* body : bodies_) is_settled = body->settle_friction() && is_settled;
  return is_settled;
}

bool ImplicitStep::descend_to_minimum(ImplicitCounts& counts) {
  double potential = 0;
  bool is_known = false;  // with its forces, from the end of the last iteration
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
    is_known = is_known && !skins_.any();
    if (iteration < kRefreshes) skins_.refresh();
    if (!is_known || skins_.any()) potential = evaluate();
    is_known = true;
    if (!std::isfinite(potential)) return false;
    const bool has_converged =
        std::all_of(bodies_.begin(), bodies_.end(), [](const ImplicitBody* body) { return body->has_converged(); });
    if (has_converged) return true;
    ++counts.iterations;
    if (!newton_step(potential, counts)) return false;
  }
  return false;
}

double ImplicitStep::evaluate() {
  double energy = 0;
  for (ImplicitBody* body : bodies_) energy += body->evaluate();
  if (skins_.any()) energy += skins_.add_forces(forces_);
  for (ImplicitBody* body : bodies_) body->release_held();
  return energy;
}

bool ImplicitStep::newton_step(double& potential, ImplicitCounts& counts) {
  const Eigen::VectorXd residual = all_forces();
  const Eigen::VectorXd way = direction(counts);
  if (way.size() == 0) return false;
  const double slope = way.dot(residual);
  // Close to the minimum the energy no longer resolves a step; a full one is then right.
  double noise = 1e-12 * std::abs(potential);
  std::vector<Points> starts;
  for (const ImplicitBody* body : bodies_) {
    noise += body->noise();
    starts.push_back(body->body().positions);
  }
  for (double share = 1; share > 1e-6; share /= 2) {
    move_from(starts, share * way);
    const double there = evaluate();
    if (there <= potential - 1e-4 * share * slope + noise) {
      potential = there;
      return true;
    }
  }
  return false;
}

void ImplicitStep::move_from(const std::vector<Points>& starts, const Eigen::VectorXd& way) {
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Eigen::Index rows = starts[i].rows();
    bodies_[i]->body().positions = starts[i] + Eigen::Map<const Points>(way.data() + at, rows, 3);
    at += 3 * rows;
  }
}

Eigen::VectorXd ImplicitStep::all_forces() const {
  Eigen::Index size = 0;
  for (const Points* forces : forces_) size += forces->size();
  Eigen::VectorXd all(size);
  Eigen::Index at = 0;
  for (const Points* forces : forces_) {
    all.segment(at, forces->size()) = Eigen::Map<const Eigen::VectorXd>(forces->data(), forces->size());
    at += forces->size();
  }
  return all;
}

/// Newton's direction, from the true curvature where that is positive, else from its positive part.
Eigen::VectorXd ImplicitStep::direction(ImplicitCounts& counts) {
  const std::vector<Coupling> couplings = skins_.couplings();
  for (const bool definite : {false, true}) {
    Eigen::VectorXd way = couplings.empty() ? direction_apart(definite) : direction(definite, couplings, counts);
    if (way.size() > 0 && way.allFinite()) return way;
  }
  return {};
}

Eigen::VectorXd ImplicitStep::direction(bool definite, const std::vector<Coupling>& couplings, ImplicitCounts& counts) {
  std::vector<std::vector<PointStiffness>> own = own_parts(couplings, bodies_.size());
  std::vector<CoupledBody> coupled;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i]->linearize(definite, std::move(own[i]))) return {};
    coupled.push_back({&bodies_[i]->body(), &bodies_[i]->supports(), &bodies_[i]->system()});
  }
  return solve_coupled(coupled, couplings, all_forces(), kSolveTolerance, counts.coupled);
}

Eigen::VectorXd ImplicitStep::direction_apart(bool definite) {
  Eigen::VectorXd all = all_forces();
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!bodies_[i]->linearize(definite)) return {};
    const Eigen::VectorXd way = bodies_[i]->solve(kSolveTolerance);
    if (way.size() == 0) return {};
    all.segment(at, way.size()) = way;
    at += way.size();
  }
  return all;
}

}  // namespace sprung
