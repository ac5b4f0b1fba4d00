#include "core/law/equation_count.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/error.h"
#include "core/types.h"

namespace sprung {
namespace {

using Strain = Eigen::Matrix3d;

constexpr double kSame = 1e-9;       // relative: numbers closer than that are the same
constexpr double kAnyPoisson = 0.3;  // the counts do not depend on it
constexpr double kMinPoisson = -0.9;
constexpr double kMaxPoisson = 0.49;
constexpr int kScan = 140;  // ratios tested between the two

/// What symmetry can distinguish: the sides that a spring spans; for an entry of M a negative mark, then its sides.
using UnknownClass = std::vector<double>;

/// The springs of one element, and which unknown each of them has for its stiffness.
class Network {
 public:
  explicit Network(const SpringConfiguration& configuration) : configuration_(configuration) {
    const int masks = 1 << configuration.dimensions;
    for (int differing = 1; differing <= configuration.dimensions; ++differing) {
      for (int mask = 1; mask < masks; ++mask) {
        if (std::popcount(unsigned(mask)) == differing && has(differing)) add_springs(mask);
      }
    }
    if (!configuration.corrected) return;
    for (int apart = 0; apart < configuration.dimensions; ++apart) {
      for (int i = 0; i + apart < configuration.dimensions; ++i) {
        const int j = i + apart;
        correction_class_[i][j] = class_of(apart == 0 ? UnknownClass{-2, side(i)} : UnknownClass{-1, side(i), side(j)});
      }
    }
  }

  [[nodiscard]] int unknowns() const { return isize(classes_); }

  /// One equation's coefficients, 1/m: sum of s s' / volume for the stretches s, s' under two strains, unknown by
  /// unknown.
  [[nodiscard]] Eigen::RowVectorXd coefficients(const Strain& strain, const Strain& other) const {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(unknowns());
    for (const Spring& spring : springs_) {
      const Eigen::Vector3d& v = spring.vector;
      row[spring.unknown] += v.dot(strain * v) * v.dot(other * v) / v.squaredNorm();
    }
    if (configuration_.corrected) add_correction(strain, other, row);
    double volume = 1;
    for (int axis = 0; axis < configuration_.dimensions; ++axis) volume *= side(axis);
    return row / volume;
  }

 private:
  struct Spring {
    Eigen::Vector3d vector;  // at rest, m
    int unknown;
  };

  [[nodiscard]] bool has(int differing) const {
    const std::vector<int>& kinds = configuration_.springs;
    return std::find(kinds.begin(), kinds.end(), differing) != kinds.end();
  }

  [[nodiscard]] double side(int axis) const { return configuration_.sides[axis]; }

  int class_of(UnknownClass wanted) {
    std::sort(wanted.begin(), wanted.end());
    const auto found = std::find(classes_.begin(), classes_.end(), wanted);
    if (found != classes_.end()) return int(found - classes_.begin());
    classes_.push_back(std::move(wanted));
    return unknowns() - 1;
  }

  /// All springs whose ends differ in the coordinates of `mask`. A mirror image or an exchange of equal sides takes any
  /// of them to any other that spans the same sides.
  void add_springs(int mask) {
    UnknownClass spanned;
    for (int axis = 0; axis < configuration_.dimensions; ++axis) {
      if ((mask >> axis & 1) != 0) spanned.push_back(side(axis));
    }
    const int unknown = class_of(spanned);
    for (int from = 0; from < 1 << configuration_.dimensions; ++from) {
      const int to = from ^ mask;
      if (from < to) springs_.push_back({corner(to) - corner(from), unknown});
    }
  }

  [[nodiscard]] Eigen::Vector3d corner(int which) const {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < configuration_.dimensions; ++axis) position[axis] = (which >> axis & 1) * side(axis);
    return position;
  }

  void add_correction(const Strain& strain, const Strain& other, Eigen::RowVectorXd& row) const {
    for (int i = 0; i < configuration_.dimensions; ++i) {
      for (int j = 0; j < configuration_.dimensions; ++j) {
        const std::size_t low = std::min(i, j);
        const std::size_t high = std::max(i, j);
        row[correction_class_[low][high]] += side(i) * strain(i, i) * side(j) * other(j, j);
      }
    }
  }

  const SpringConfiguration& configuration_;
  std::vector<UnknownClass> classes_;
  std::vector<Spring> springs_;
  std::array<std::array<int, 3>, 3> correction_class_{};
};

/// A stretch of 1 along an axis (i = j), or a shear by the angle 1 in a plane.
Strain unit_strain(int i, int j) {
  Strain strain = Strain::Zero();
  strain(i, j) += 0.5;
  strain(j, i) += 0.5;
  return strain;
}

/// Collects equations, leaving out those that say nothing and those that repeat another of their kind.
class Equations {
 public:
  explicit Equations(int unknowns) { found_.matrix.resize(0, unknowns); }

  void add(EquationKind kind, const Eigen::RowVectorXd& row, double right) {
    if (row.cwiseAbs().maxCoeff() < kSame && std::abs(right) < kSame) return;
    const Eigen::Index count = found_.right.size();
    for (Eigen::Index i = 0; i < count; ++i) {
      const bool same = found_.kinds[i] == kind && std::abs(found_.right[i] - right) < kSame &&
                        (found_.matrix.row(i) - row).norm() < kSame * row.norm();
      if (same) return;
    }
    found_.matrix.conservativeResize(count + 1, Eigen::NoChange);
    found_.matrix.row(count) = row;
    found_.right.conservativeResize(count + 1);
    found_.right[count] = right;
    found_.kinds.push_back(kind);
  }

  [[nodiscard]] SpringEquations take() { return std::move(found_); }

 private:
  SpringEquations found_;
};

/// The relative residual of the best stiffnesses; zero if there is a solution.
double misfit(const SpringConfiguration& configuration, double poisson) {
  const SpringEquations equations = spring_equations(configuration, poisson);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(kSame);
  solver.compute(equations.matrix);
  const Eigen::VectorXd stiffnesses = solver.solve(equations.right);
  return (equations.matrix * stiffnesses - equations.right).norm() / equations.right.norm();
}

/// Golden section. The misfit falls linearly to a zero, so it is found to rounding.
double min_misfit(const SpringConfiguration& configuration, double low, double high) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  while (high - low > 1e-14) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    if (misfit(configuration, left) < misfit(configuration, right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return (low + high) / 2;
}

void find_solvable_ratios(const SpringConfiguration& configuration, EquationCount& count) {
  const double stride = (kMaxPoisson - kMinPoisson) / kScan;
  Eigen::VectorXd misfits(kScan + 1);
  for (int i = 0; i <= kScan; ++i) misfits[i] = misfit(configuration, kMinPoisson + i * stride);
  count.solvable = misfits.maxCoeff() < kSame;
  if (count.solvable) return;
  int best = 0;
  misfits.minCoeff(&best);
  const double centre = kMinPoisson + best * stride;
  const double poisson = min_misfit(configuration, centre - stride, centre + stride);
  if (misfit(configuration, poisson) < kSame) count.poisson = poisson;
}

EquationCount count_equations(const SpringConfiguration& configuration) {
  const SpringEquations equations = spring_equations(configuration, kAnyPoisson);
  const auto of_kind = [&](EquationKind kind) {
    return int(std::count(equations.kinds.begin(), equations.kinds.end(), kind));
  };
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver;
  solver.setThreshold(kSame);
  solver.compute(equations.matrix);
  EquationCount count;
  count.name = configuration.name;
  count.unknowns = int(equations.matrix.cols());
  count.equations = int(equations.matrix.rows());
  count.young_equations = of_kind(EquationKind::kYoung);
  count.poisson_equations = of_kind(EquationKind::kPoisson);
  count.shear_equations = of_kind(EquationKind::kShear);
  count.rank = int(solver.rank());
  find_solvable_ratios(configuration, count);
  return count;
}

}  // namespace

SpringEquations spring_equations(const SpringConfiguration& configuration, double poisson) {
  const Network network(configuration);
  if (network.unknowns() == 0) {
    throw Error(ErrorKind::kUsage, fmt::format("configuration {} has no springs", configuration.name));
  }
  const int axes = configuration.dimensions;
  Equations equations(network.unknowns());
  for (int along = 0; along < axes; ++along) {
    Strain elongation = -poisson * Strain::Identity();
    elongation(along, along) = 1;
    for (int i = 0; i < axes; ++i) {
      for (int j = i; j < axes; ++j) {
        const bool young = i == along && j == along;
        equations.add(young ? EquationKind::kYoung : EquationKind::kPoisson,
                      network.coefficients(elongation, unit_strain(i, j)), young ? 1 : 0);
      }
    }
  }
  for (int along = 0; along < axes; ++along) {
    for (int across = along + 1; across < axes; ++across) {
      const Strain shear = unit_strain(along, across);
      for (int i = 0; i < axes; ++i) {
        for (int j = i; j < axes; ++j) {
          const double stress = i == along && j == across ? 1 / (2 * (1 + poisson)) : 0;
          equations.add(EquationKind::kShear, network.coefficients(shear, unit_strain(i, j)), stress);
        }
      }
    }
  }
  return equations.take();
}

std::vector<EquationCount> count_equations(std::span<const SpringConfiguration> configurations) {
  std::vector<EquationCount> counts;
  for (const SpringConfiguration& configuration : configurations) counts.push_back(count_equations(configuration));
  return counts;
}

std::vector<SpringConfiguration> table_configurations() {
  const std::array<double, 3> equal{1, 1, 1};
  const std::array<double, 3> unequal{1, 1.25, 0.8};
  std::vector<SpringConfiguration> all;
  for (const bool corrected : {false, true}) {
    for (const auto& sides : {equal, unequal}) {
      const bool cube = sides == equal;
      const std::string end = corrected ? ", corrected" : "";
      all.push_back({(cube ? "2D square" : "2D rectangle") + end, 2, sides, {1, 2}, corrected});
      const std::string shape = (cube ? " cube" : " box") + end;
      all.push_back({"M1" + shape, 3, sides, {1, 2}, corrected});
      all.push_back({"M2" + shape, 3, sides, {1, 3}, corrected});
      all.push_back({"M3" + shape, 3, sides, {1, 2, 3}, corrected});
    }
  }
  return all;
}

}  // namespace sprung
