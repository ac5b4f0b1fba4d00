#include <array>
#include <cmath>
#include <random>

#include "app/validate/built_in_cases.h"
#include "app/validate/membrane_run.h"
#include "core/error.h"

namespace sprung {
namespace {

using Mat2 = Eigen::Matrix2d;

constexpr double kExact = 1e-9;
constexpr double kSide = 0.1;      // of a rectangle along x, m
constexpr double kFlatness = 0.9;  // of a rectangle: its side along y over that along x
constexpr double kStrain = 0.01;
constexpr unsigned kSeed = 20091;
constexpr std::array<double, 8> kRatios{-0.2, 0, 0.1, 0.25, 0.3, 1.0 / 3, 0.4, 0.49};

/// A stretch along x, one along y, or a shear.
Mat2 strain_of(int which) {
  Mat2 strain = Mat2::Zero();
  if (which < 2) {
    strain(which, which) = kStrain;
  } else {
    strain(0, 1) = strain(1, 0) = kStrain;
  }
  return strain;
}

/// Energy of plane stress, J/m3.
double energy_density(const Material& material, const Mat2& strain) {
  const double nu = material.poisson;
  const Mat2 stress = material.young / (1 - nu * nu) * (nu * strain.trace() * Mat2::Identity() + (1 - nu) * strain);
  return 0.5 * stress.cwiseProduct(strain).sum();
}

/// Displacements where the sides are held in that strain; the inner nodes are pushed by what the sides do to them.
Points2 answer(MembraneRun& run, const Points2& uniform) {
  Membrane& membrane = run.membrane();
  Points2 held = uniform;
  for (int row = 0; row <= run.rows(); ++row) {
    for (int column = 0; column <= run.columns(); ++column) {
      const int node = run.node(column, row);
      const bool is_inner = row > 0 && row < run.rows() && column > 0 && column < run.columns();
      if (is_inner) {
        held.row(node).setZero();
      } else {
        membrane.fix(node, 0);
        membrane.fix(node, 1);
      }
    }
  }
  const Eigen::SparseMatrix<double> stiffness = stiffness_matrix(membrane, false);
  const Eigen::Map<const Eigen::VectorXd> pushed(held.data(), held.size());
  const Eigen::VectorXd push = -(stiffness.selfadjointView<Eigen::Lower>() * pushed);
  run.loads() = Eigen::Map<const Points2>(push.data(), membrane.node_count(), 2);
  return held + run.displacements();
}

double energy_of(const Membrane& membrane, const Points2& moved) {
  const Eigen::SparseMatrix<double> stiffness = stiffness_matrix(membrane, false);
  const Eigen::Map<const Eigen::VectorXd> u(moved.data(), moved.size());
  return 0.5 * u.dot(stiffness.selfadjointView<Eigen::Lower>() * u);
}

/// Measures the worst of the three strains: how far inner nodes are off, and the energy.
void measure(const MembraneCounts& counts, RectangleModel model, double poisson, Check& inner, Check& energy) {
  const Vec2 size(kSide * counts[0], kFlatness * kSide * counts[1]);
  inner.measured = 0;
  for (int which = 0; which < 3; ++which) {
    MembraneRun run(counts, size, model, poisson);
    const Mat2 strain = strain_of(which);
    const Points2 uniform = run.membrane().rest_positions * strain;
    const Points2 moved = answer(run, uniform);
    inner.measured = std::max(inner.measured, (moved - uniform).cwiseAbs().maxCoeff() / uniform.cwiseAbs().maxCoeff());
    const double stored = energy_of(run.membrane(), moved);
    const double expected = size.prod() * energy_density(membrane_material(poisson), strain);
    if (which > 0 && std::abs(stored / expected - 1) < std::abs(energy.error())) continue;
    energy.measured = stored;
    energy.expected = expected;
  }
}

}  // namespace

CaseResult run_membrane_patch(const Choice& choice) {
  std::mt19937 random(kSeed);
  CaseResult result;
  for (const double poisson :
       choice.poisson ? std::vector<double>{*choice.poisson} : std::vector<double>(kRatios.begin(), kRatios.end())) {
    const MembraneCounts drawn{2 + int(random() % 4), 2 + int(random() % 4)};
    const MembraneCounts counts = membrane_counts(choice, {drawn}).front();
    for (const MembraneModel& model : membrane_models(choice)) {
      Check inner = membrane_check("membrane_patch", model, poisson, counts);
      inner.quantity = "inner.displacement";
      inner.source = "a uniform strain, error over the largest displacement";
      Check energy = membrane_check("membrane_patch", model, poisson, counts);
      energy.quantity = "energy";
      energy.unit = 'J';
      energy.source = "plane stress, energy = stress : strain / 2 x area x 1 m";
      try {
        measure(counts, model.model, poisson, inner, energy);
        inner.tolerance = kExact;
        if (is_exact(model.model, poisson)) energy.tolerance = kExact;
      } catch (const Error& error) {
        inner.trouble = energy.trouble = error.what();
      }
      result.checks.push_back(inner);
      result.checks.push_back(energy);
    }
  }
  return result;
}

}  // namespace sprung
