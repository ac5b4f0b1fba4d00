#include "core/dynamics/statics/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/body/brick_hessian.h"
#include "core/body/forces.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/dynamics/statics/free_motion.h"
#include "core/dynamics/statics/load_steps.h"
#include "core/dynamics/statics/rotated_step.h"
#include "core/error.h"

namespace sprung {
namespace {

/// K u: the forces (m x 3, N) that maintain the displacements u, without supporting springs.
Points holding_forces(const Body& body, const Points& displacements) {
  Points forces = Points::Zero(body.node_count(), 3);
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    const auto& nodes = body.grid.nodes[brick];
    Eigen::Matrix<double, 24, 1> u;
    for (int c = 0; c < 8; ++c) {
      u.segment<3>(Eigen::Index{3} * c) = displacements.row(nodes[c]).transpose();
    }
    const Eigen::Matrix<double, 24, 1> f = body_brick_hessian(body, brick) * u;
    for (int c = 0; c < 8; ++c) {
      forces.row(nodes[c]) += f.segment<3>(Eigen::Index{3} * c).transpose();
    }
  }
  return forces;
}

/// Adds the springs' reactions at free degrees of freedom; those at fixed ones are included already.
void add_spring_reactions(const Body& body, const Supports& supports, const Points& displacements, Points& reactions) {
  if (supports.springs.empty()) return;
  const Points forces = support_forces(supports.springs, body, displacements);
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    if (!supports.fixed[i]) reactions.data()[i] += forces.data()[i];
  }
}

}  // namespace

LinearResponse linear_response(const Body& body, const Supports& supports, const Points& loads, const Points& movements,
                               LinearSolver& system) {
  LinearResponse response;
  response.displacements = Points::Zero(body.node_count(), 3);
  for (Eigen::Index i = 0; i < movements.size(); ++i) {
    if (supports.fixed[i]) response.displacements.data()[i] = movements.data()[i];
  }
  if (std::find(supports.fixed.begin(), supports.fixed.end(), false) != supports.fixed.end()) {
    const Points moved = body.positions - body.rest_positions + response.displacements;
    const Points driving =
        loads + support_forces(supports.springs, body, moved) - holding_forces(body, response.displacements);
    const Eigen::VectorXd free = solve_linear(body, supports, driving, system);
    response.displacements += Eigen::Map<const Points>(free.data(), body.node_count(), 3);
  }
  response.reactions = holding_forces(body, response.displacements) - loads;
  for (Eigen::Index i = 0; i < movements.size(); ++i) {
    if (!supports.fixed[i]) response.reactions.data()[i] = 0;
  }
  add_spring_reactions(body, supports, body.positions - body.rest_positions + response.displacements,
                       response.reactions);
  return response;
}

namespace {

constexpr double kLongestStep = 0.5;  // body lengths; a longer one is useless
constexpr double kLinearTolerance = 1e-11;
constexpr double kPreconditioning = 1e-4;  // of a correction in conjugate gradients
constexpr double kFirstMove = 0.1;         // bricks, along a direction of negative curvature
constexpr double kFarthest = 1024;         // times as far

Eigen::Map<const Eigen::VectorXd> flat(const Points& points) { return {points.data(), points.size()}; }

double extent(const Body& body) {
  return (body.positions.colwise().maxCoeff() - body.positions.colwise().minCoeff()).maxCoeff() +
         body.positions.cwiseAbs().maxCoeff();
}

/// Newton's method at one load.
class Equilibrium {
 public:
  /// `rotated`: of the body and these supports.
  Equilibrium(Body& body, const Supports& supports, const Points& loads, LinearSolver& system, RotatedStep& rotated,
              const StaticOptions& options)
      : body_(body),
        supports_(supports),
        loads_(loads),
        system_(system),
        terms_(support_terms(supports)),
        options_(options),
        rotated_(rotated),
        rounding_(4 * std::numeric_limits<double>::epsilon() * extent(body)),
        rounding_force_(8 * largest_brick_stiffness(body) * rounding_) {}

  /// False if it does not converge; the body is then in an arbitrary state.
  bool find(StaticReport& report) {
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      if (options_.between) options_.between();
      const Eigen::VectorXd residual = unbalanced();
      report.residual = residual.lpNorm<Eigen::Infinity>() / largest_force_;
      if (!std::isfinite(report.residual)) return false;
      if (report.residual <= std::max(options_.tolerance, rounding_force_ / largest_force_)) return true;
      ++report.iterations;
      if (!step(residual)) return false;
    }
    return false;
  }

 private:
  /// Force on each free degree of freedom, 3 m; also notes the largest force at work.
  Eigen::VectorXd unbalanced() {
    spring_forces(body_, workspace_, forces_);
    largest_force_ = std::max({flat(forces_).lpNorm<Eigen::Infinity>(), flat(loads_).lpNorm<Eigen::Infinity>(),
                               std::numeric_limits<double>::min()});
    if (!supports_.springs.empty()) {
      forces_ += support_forces(supports_.springs, body_, body_.positions - body_.rest_positions);
    }
    Eigen::VectorXd total = flat(forces_) + flat(loads_);
    for (int i = 0; i < total.size(); ++i) {
      if (supports_.fixed[i]) total[i] = 0;
    }
    return total;
  }

  double potential() {
    return elastic_energy(body_, workspace_) +
           support_energy(supports_.springs, body_, body_.positions - body_.rest_positions) -
           flat(loads_).dot(flat(body_.positions));
  }

  /// One descent step: in Newton's direction if the curvature is positive; otherwise along negative curvature, or in
  /// the direction from the positive part of the curvature: in systems of springs, negative curvature can lead from
  /// ridges into crushed bricks. False if no step lowers the energy any more.
  bool step(const Eigen::VectorXd& residual) {
    if (system_.linearize(body_, supports_, false, terms_)) {
      const Eigen::VectorXd direction = system_.solve(residual, options_.direction_tolerance);
      if (is_short(direction)) return search_along(direction, residual) > 0;
      if (!has_springs(body_.model) && descend(system_.downhill(), residual)) return true;
    }
    if (!system_.linearize(body_, supports_, true, terms_)) return false;
    const Eigen::VectorXd direction = shortened(system_.solve(residual, options_.direction_tolerance));
    return direction.size() > 0 && search_along(direction, residual) > 0;
  }

  /// Steps along a direction of negative curvature, whose length is unknown.
  bool descend(const Eigen::VectorXd& downhill, const Eigen::VectorXd& residual) {
    if (!std::isfinite(length_of(downhill))) return false;
    const double bricks = downhill.cwiseAbs().maxCoeff() / body_.grid.brick_size;
    const Eigen::VectorXd direction = downhill / std::max(1.0, bricks / kFirstMove);
    const Points before = body_.positions;
    double share = search_along(direction, residual);
    if (share == 0) return false;
    Points lowest = body_.positions;
    for (double energy = potential(); share < kFarthest && is_short(2 * share * direction); share *= 2) {
      move_along(before, 2 * share * direction);
      const double further = potential();
      if (further >= energy) break;
      energy = further;
      lowest = body_.positions;
    }
    body_.positions = lowest;
    return true;
  }

  /// The first share of 1, 1/2, 1/4, ... of a direction that lowers the energy enough; the body is moved there. 0:
  /// none, and the body is unchanged.
  double search_along(const Eigen::VectorXd& direction, const Eigen::VectorXd& residual) {
    const double slope = direction.dot(residual);
    const double rotation = rotated_.largest_rotation(body_.positions, direction);
    const Points before = body_.positions;
    const double energy = potential();
    // Close to the minimum the energy no longer resolves a step (what a rounded position costs, and how it is rounded
    // itself); a full Newton step is then right.
    const double noise = rounding_ * (flat(loads_).lpNorm<1>() + corner_force_sum(body_)) + energy_rounding(body_);
    for (double share = 1; share > 1e-8; share /= 2) {
      const double enough = energy - 1e-4 * share * slope + noise;
      if (energy_after(before, share * direction, share * rotation, enough) <= enough) return share;
    }
    body_.positions = before;
    return 0;
  }

  /// Moves the body from there by a displacement, along a straight line or, if that does not bring its potential down
  /// to what is enough, by finite rotations. `rotation`: the largest in it, radians. Returns the potential.
  double energy_after(const Points& from, const Eigen::VectorXd& way, double rotation, double enough) {
    move_along(from, way);
    const double straight = potential();
    if (straight <= enough || !(rotation > kSmallRotation)) return straight;
    const Points turned = rotated_.displaced(from, way);
    if (turned.rows() == 0) return straight;
    body_.positions = turned;
    const double around = potential();
    if (around < straight || !std::isfinite(straight)) return around;
    move_along(from, way);
    return straight;
  }

  void move_along(const Points& from, const Eigen::VectorXd& way) {
    body_.positions = from;
    Eigen::Map<Eigen::VectorXd>(body_.positions.data(), body_.positions.size()) += way;
  }

  /// Relative to the longest useful step; infinity for none, or one that is not finite.
  [[nodiscard]] double length_of(const Eigen::VectorXd& direction) const {
    if (direction.size() == 0 || !direction.allFinite()) return std::numeric_limits<double>::infinity();
    return direction.cwiseAbs().maxCoeff() / (kLongestStep * extent(body_));
  }
  [[nodiscard]] bool is_short(const Eigen::VectorXd& direction) const { return length_of(direction) <= 1; }

  /// Empty if there is no such direction.
  [[nodiscard]] Eigen::VectorXd shortened(const Eigen::VectorXd& direction) const {
    const double length = length_of(direction);
    return std::isfinite(length) ? (direction / std::max(1.0, length)).eval() : Eigen::VectorXd();
  }

  Body& body_;
  const Supports& supports_;
  const Points& loads_;
  LinearSolver& system_;
  const StepTerms terms_;
  const StaticOptions& options_;
  RotatedStep& rotated_;
  double rounding_;        // of a position, m
  double rounding_force_;  // that it causes, N
  ForceWorkspace workspace_;
  Points forces_;
  double largest_force_ = 0;
};

/// K and supporting springs at the body's current positions, in double precision and without added terms; zero at fixed
/// supports.
class ExactProduct {
 public:
  ExactProduct(const Body& body, const Supports& supports)
      : body_(body), supports_(supports), largest_(largest_brick_stiffness(body)) {}

  [[nodiscard]] Eigen::VectorXd free_part(Eigen::VectorXd vector) const {
    for (Eigen::Index i = 0; i < vector.size(); ++i) {
      if (supports_.fixed[i]) vector[i] = 0;
    }
    return vector;
  }

  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& displacement) const {
    Eigen::VectorXd product;
    multiply_stiffness(body_, displacement, workspace_, product);
    for (const SpringSupport& support : supports_.springs) {
      add_point_product(body_, support.spring, displacement, product);
    }
    return free_part(std::move(product));
  }

  /// Whether the forces are balanced up to rounded displacements; never with a residual of more than a millionth.
  [[nodiscard]] bool is_solution(const Eigen::VectorXd& displacement, const Eigen::VectorXd& forces) const {
    if (displacement.size() == 0 || !displacement.allFinite()) return false;
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * largest_ * displacement.norm();
    const double left = (forces - times(displacement)).norm();
    return left <= std::min(1e-6 * forces.norm(), 1e-9 * forces.norm() + rounding);
  }

 private:
  const Body& body_;
  const Supports& supports_;
  double largest_;
  mutable ProductWorkspace workspace_;
};

}  // namespace

Eigen::VectorXd solve_linear(const Body& body, const Supports& supports, const Points& loads, LinearSolver& system) {
  const ExactProduct stiffness(body, supports);
  const Eigen::VectorXd forces = stiffness.free_part(flat(loads));
  const StepTerms terms = support_terms(supports);
  if (system.linearize(body, supports, false, terms)) {
    Eigen::VectorXd displacement = system.solve(forces, kLinearTolerance);
    if (stiffness.is_solution(displacement, forces)) return displacement;
  }
  // Motions with (almost) no resistance, such as a thin bar of plain springs that may twist, do no harm if no load
  // drives them. The slightly stiffened system is a good preconditioner for the original one.
  const std::unique_ptr<LinearSolver> definite_solver = make_robust_solver(body);
  if (definite_solver->linearize(body, supports, true, terms)) {
    SolveReport report;
    Eigen::VectorXd displacement = conjugate_gradients(
        forces, {.tolerance = kLinearTolerance, .fallback_tolerance = kLinearTolerance, .max_iterations = 200},
        [&](const Eigen::VectorXd& x, Eigen::VectorXd& product) { product = stiffness.times(x); },
        [&](const Eigen::VectorXd& residual, Eigen::VectorXd& correction) {
          correction = definite_solver->solve(residual, kPreconditioning);
          if (correction.size() == 0) correction.setZero(residual.size());
        },
        report);
    if (stiffness.is_solution(displacement, forces)) return displacement;
  }
  throw_if_free(body, supports, "the loads have no equilibrium");
  throw Error(ErrorKind::kFailed,
              "the linear system could not be solved to the accuracy of its loads: the body is nearly free to move; "
              "support more of it, or use more bricks where it is thin");
}

StaticReport solve_static(Body& body, const Supports& supports, const Points& loads, const Points& start,
                          LinearSolver& system, const StaticOptions& options) {
  const Points goal = body.positions;
  const auto move_supports = [&](double share) {
    for (int i = 0; i < goal.size(); ++i) {
      if (!supports.fixed[i]) continue;
      body.positions.data()[i] = start.data()[i] + share * (goal.data()[i] - start.data()[i]);
    }
  };
  Supports moving = supports;
  const auto move_springs = [&](double share) {
    for (std::size_t i = 0; i < moving.springs.size(); ++i) {
      const SpringSupport& support = supports.springs[i];
      const Vec3 stretch = stretch_of(support, body.grid.nodes[support.spring.brick], start - body.rest_positions);
      moving.springs[i].displacement = support.displacement - (1 - share) * stretch;
    }
  };
  StaticReport report;
  RotatedStep rotated(body, moving);
  body.positions = start;
  const double reached = raise_load(options, report, [&](double share) {
    const Points before = body.positions;
    move_supports(share);
    move_springs(share);
    const Points load = share * loads;
    if (Equilibrium(body, moving, load, system, rotated, options).find(report)) return true;
    body.positions = before;
    return false;
  });
  if (reached == 1) return report;
  throw_if_free(body, supports, "no equilibrium found");
  throw Error(ErrorKind::kDiverged,
              fmt::format("no equilibrium found beyond {:.3g} of the load (residual {:.2g}): the body may have buckled "
                          "or collapsed; use a stiffer material, a smaller load or more bricks",
                          reached, report.residual));
}

Points reactions(const Body& body, const Supports& supports, const Points& loads) {
  ForceWorkspace workspace;
  Points forces;
  spring_forces(body, workspace, forces);
  Points pin_forces = -(forces + loads);
  for (int i = 0; i < pin_forces.size(); ++i) {
    if (!supports.fixed[i]) pin_forces.data()[i] = 0;
  }
  add_spring_reactions(body, supports, body.positions - body.rest_positions, pin_forces);
  return pin_forces;
}

}  // namespace sprung
