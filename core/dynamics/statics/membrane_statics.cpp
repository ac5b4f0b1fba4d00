#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "core/dynamics/statics/load_steps.h"
#include "core/error.h"

namespace sprung {
namespace {

using Cholesky = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

constexpr double kLongestMembraneStep = 0.5;  // membrane lengths; a longer one is useless
constexpr double kFreeMembrane = 1e4;         // a displacement of that many membrane lengths is no deformation
constexpr double kShift = 1e-9;               // of the largest entry, where a matrix may be singular

double extent(const Membrane& membrane) { return membrane.rest_positions.colwise().maxCoeff().maxCoeff(); }

Eigen::Map<const Eigen::VectorXd> flat(const Points2& points) { return {points.data(), points.size()}; }

void release_supported(const Membrane& membrane, Eigen::VectorXd& forces) {
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    if (membrane.fixed[i]) forces[i] = 0;
  }
}

/// The stiffness with supported degrees of freedom fixed one by one: unknowns keep their numbers.
Eigen::SparseMatrix<double> supported_stiffness(const Membrane& membrane, bool definite) {
  Eigen::SparseMatrix<double> matrix = stiffness_matrix(membrane, definite);
  const double pinned_diagonal = matrix.diagonal().maxCoeff();
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
      const bool fixed = membrane.fixed[entry.row()] || membrane.fixed[column];
      if (fixed) entry.valueRef() = entry.row() == column ? pinned_diagonal : 0;
    }
  }
  return matrix;
}

/// Displacements for forces (zero at supports), both 2 m. Empty if the stiffness is not positive definite.
Eigen::VectorXd displacement(const Membrane& membrane, const Eigen::VectorXd& forces, bool definite) {
  const Eigen::SparseMatrix<double> matrix = supported_stiffness(membrane, definite);
  Cholesky cholesky;
  if (definite) cholesky.setShift(kShift * matrix.diagonal().maxCoeff());
  cholesky.compute(matrix);
  if (cholesky.info() != Eigen::Success) return {};
  return cholesky.solve(forces);
}

/// Newton's direction, from the true curvature where that is positive, else from its positive part; empty: neither.
Eigen::VectorXd downhill(const Membrane& membrane, const Eigen::VectorXd& residual) {
  for (const bool definite : {false, true}) {
    Eigen::VectorXd direction = displacement(membrane, residual, definite);
    if (direction.size() == 0 || !direction.allFinite()) continue;
    const double longest = direction.lpNorm<Eigen::Infinity>() / (kLongestMembraneStep * extent(membrane));
    if (longest > 1 && !definite) continue;
    return direction / std::max(1.0, longest);
  }
  return {};
}

double potential(const Membrane& membrane, const Points2& loads) {
  return elastic_energy(membrane) - flat(loads).dot(flat(membrane.positions));
}

/// One step downhill. False if no step lowers the energy any more.
bool step(Membrane& membrane, const Points2& loads, const Eigen::VectorXd& residual, double noise) {
  const Eigen::VectorXd direction = downhill(membrane, residual);
  if (direction.size() == 0) return false;
  const double slope = direction.dot(residual);
  const double energy = potential(membrane, loads);
  const Points2 before = membrane.positions;
  for (double share = 1; share > 1e-8; share /= 2) {
    membrane.positions = before;
    membrane.positions.reshaped<Eigen::RowMajor>() += share * direction;
    if (potential(membrane, loads) <= energy - 1e-4 * share * slope + noise) return true;
  }
  membrane.positions = before;
  return false;
}

/// Newton's method at one load. False if it does not converge; the membrane is then in an arbitrary state.
bool find_equilibrium(Membrane& membrane, const Points2& loads, const StaticOptions& options, StaticReport& report) {
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * extent(membrane);
  const double stiffness = rectangle_hessian(membrane.law, rest_corners(membrane.law)).trace();
  const double rounding_force = 8 * rounding * stiffness;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    const Points2 springs = spring_forces(membrane);
    Eigen::VectorXd residual = flat(springs) + flat(loads);
    const double largest = std::max({flat(springs).lpNorm<Eigen::Infinity>(), flat(loads).lpNorm<Eigen::Infinity>(),
                                     std::numeric_limits<double>::min()});
    release_supported(membrane, residual);
    report.residual = residual.lpNorm<Eigen::Infinity>() / largest;
    if (!std::isfinite(report.residual)) return false;
    if (report.residual <= std::max(options.tolerance, rounding_force / largest)) return true;
    ++report.iterations;
    // Close to the minimum the energy no longer resolves a step; a full Newton step is then right.
    const double tensions = std::sqrt(12 * double(membrane.rectangles.size()) * stiffness *
                                      std::max(0.0, elastic_energy(membrane)));  // at most, all springs together
    const double noise = rounding * (flat(loads).lpNorm<1>() + tensions);
    if (!step(membrane, loads, residual, noise)) return false;
  }
  return false;
}

}  // namespace

Points2 solve_linear(const Membrane& membrane, const Points2& loads) {
  Eigen::VectorXd forces = flat(loads);
  release_supported(membrane, forces);
  const Eigen::VectorXd moved = displacement(membrane, forces, false);
  if (moved.size() == 0 || !(moved.lpNorm<Eigen::Infinity>() < kFreeMembrane * extent(membrane))) {
    throw Error(ErrorKind::kBadInput,
                "the supports leave the membrane free to move under its loads: support more of it");
  }
  return Eigen::Map<const Points2>(moved.data(), membrane.node_count(), 2);
}

StaticReport solve_static(Membrane& membrane, const Points2& loads, const StaticOptions& options) {
  StaticReport report;
  const double reached = raise_load(options, report, [&](double share) {
    const Points2 before = membrane.positions;
    const Points2 load = share * loads;
    if (find_equilibrium(membrane, load, options, report)) return true;
    membrane.positions = before;
    return false;
  });
  if (reached == 1) return report;
  throw Error(ErrorKind::kDiverged, fmt::format("no equilibrium of the membrane found beyond {:.3g} of the load "
                                                "(residual {:.2g}); use a stiffer material or a smaller load",
                                                reached, report.residual));
}

Points2 reactions(const Membrane& membrane, const Points2& loads) {
  Points2 pin_forces = -(spring_forces(membrane) + loads);
  for (Eigen::Index i = 0; i < pin_forces.size(); ++i) {
    if (!membrane.fixed[i]) pin_forces.data()[i] = 0;
  }
  return pin_forces;
}

}  // namespace sprung
