#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "app/validate/cases.h"
#include "app/validate/responses.h"
#include "core/body/membrane.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kMembraneYoung = 1000;   // Pa
constexpr double kLength = 0.4;           // m
constexpr double kHeight = 0.1;           // m
constexpr double kStress = 10;            // Pa, of stretch and shear
constexpr double kMembraneStrain = 0.01;  // of the patch
constexpr double kMembraneExact = 1e-9;
constexpr double kBeamTolerance = 0.01;
constexpr double kThird = 1.0 / 3;
constexpr unsigned kMembraneSeed = 20091;  // of the patch's grids

/// Columns and rows of a membrane.
using Counts = std::array<int, 2>;

/// A membrane of 1 kg/m2 and its loads.
struct MembraneRun {
  Counts counts;
  Vec2 size;  // m
  Membrane membrane;
  Points2 loads;  // N

  [[nodiscard]] int node(int column, int row) const { return column + row * (columns() + 1); }
  [[nodiscard]] int columns() const { return counts[0]; }
  [[nodiscard]] int rows() const { return counts[1]; }

  /// Applies a traction (Pa) to the side at that column.
  void pull_column(int column, const Vec2& traction) {
    for (int row = 0; row <= rows(); ++row) {
      const double share = row == 0 || row == rows() ? 0.5 : 1;
      loads.row(node(column, row)) += share * size.y() / rows() * traction.transpose();
    }
  }
  void pull_row(int row, const Vec2& traction) {
    for (int column = 0; column <= columns(); ++column) {
      const double share = column == 0 || column == columns() ? 0.5 : 1;
      loads.row(node(column, row)) += share * size.x() / columns() * traction.transpose();
    }
  }
  void clamp(int at) {
    membrane.fix(at, 0);
    membrane.fix(at, 1);
  }

  /// Small displacements under the loads, m.
  [[nodiscard]] Points2 displacements() const { return solve_linear(membrane, loads); }
};

struct Variant {
  RectangleModel model;
  double poisson;
  Counts counts;

  /// Plain springs represent 1/3 only.
  [[nodiscard]] bool is_exact() const { return model != RectangleModel::kPlain || std::abs(poisson - kThird) < 1e-12; }
};

/// Throws Error(kBadInput) if the model does not support the shape of the rectangles.
MembraneRun make_run(const Variant& variant, const Vec2& size = {kLength, kHeight}) {
  Membrane membrane = make_membrane(variant.counts[0], variant.counts[1], size, variant.model,
                                    light_material(kMembraneYoung, variant.poisson));
  const Points2 no_loads = Points2::Zero(membrane.node_count(), 2);
  return {variant.counts, size, std::move(membrane), no_loads};
}

/// The rectangles that correspond to a model of bricks: all three without a choice, none for fem. M1 and M2 are the
/// same in 2D, where there are only edges and diagonals.
std::vector<RectangleModel> rectangle_models(const std::optional<Model>& model) {
  if (!model) return {RectangleModel::kCalibrated, RectangleModel::kCorrected, RectangleModel::kPlain};
  if (*model == Model::kFem) return {};
  if (*model == Model::kCalibrated) return {RectangleModel::kCalibrated};
  const bool is_corrected = *model == Model::kTensile || *model == Model::kM1;
  return {is_corrected ? RectangleModel::kCorrected : RectangleModel::kPlain};
}

/// The chosen grid of a membrane four times as long as high, else the given ones.
std::vector<Counts> chosen_counts(const Choice& choice, std::vector<Counts> varied) {
  if (!choice.bricks) return varied;
  return {{*choice.bricks, std::max(1, int(std::lround(*choice.bricks / (kLength / kHeight))))}};
}

Check check_of(std::string_view experiment, const Variant& variant) {
  const std::string_view model = variant.model == RectangleModel::kCalibrated  ? "2d-calibrated"
                                 : variant.model == RectangleModel::kCorrected ? "2d-corrected"
                                                                               : "2d-plain";
  return {.experiment = std::string(experiment),
          .model = std::string(model),
          .poisson = std::round(variant.poisson * 1e4) / 1e4,
          .grid = fmt::format("{}x{}", variant.counts[0], variant.counts[1]),
          .bricks_across = double(variant.counts[1])};
}

/// A check for each ratio, model and grid; `measure` loads the membrane and fills in the check.
template <class Measure>
CaseResult run_all(std::string_view experiment, const Choice& choice, std::vector<double> ratios,
                   const std::vector<Counts>& varied_counts, const Measure& measure) {
  if (choice.poisson) ratios = {*choice.poisson};
  CaseResult result;
  for (const double poisson : ratios) {
    for (const RectangleModel model : rectangle_models(choice.model)) {
      for (const Counts& counts : chosen_counts(choice, varied_counts)) {
        const Variant variant{model, poisson, counts};
        Check& check = result.checks.emplace_back(check_of(experiment, variant));
        check.unit = 'm';
        try {
          MembraneRun run = make_run(variant);
          measure(run, variant, check);
        } catch (const Error& error) {
          check.trouble = error.what();
        }
      }
    }
  }
  return result;
}

/// The second and third grid have rectangles that are not square.
const std::vector<Counts> kUniformCounts{{4, 1}, {5, 1}, {10, 2}};
const std::vector<double> kUniformRatios{0, 0.1, kThird, 0.45};

/// Pulls the far end; two sides slide along axes of symmetry.
void stretch(MembraneRun& run) {
  for (int row = 0; row <= run.rows(); ++row) run.membrane.fix(run.node(0, row), 0);
  for (int column = 0; column <= run.columns(); ++column) run.membrane.fix(run.node(column, 0), 1);
  run.pull_column(run.columns(), {kStress, 0});
}

/// Tractions along all four sides; the bottom neither rises nor rotates.
void shear(MembraneRun& run) {
  run.clamp(run.node(0, 0));
  run.membrane.fix(run.node(run.columns(), 0), 1);
  run.pull_column(run.columns(), {0, kStress});
  run.pull_column(0, {0, -kStress});
  run.pull_row(run.rows(), {kStress, 0});
  run.pull_row(0, {-kStress, 0});
}

/// Clamps one end and applies the weight.
void hang(MembraneRun& run) {
  for (int row = 0; row <= run.rows(); ++row) run.clamp(run.node(0, row));
  run.loads.col(1) = -run.membrane.masses;
}

CasePicture draw(void (*load)(MembraneRun&), double magnification) {
  MembraneRun run = make_run({RectangleModel::kCalibrated, 0.3, {16, 4}});
  load(run);
  run.membrane.positions += run.displacements();
  return {draw_membrane(run.membrane, {.magnification = magnification}),
          fmt::format("16×4 rectangles, ν = 0.3, displacements magnified {:g} times", magnification)};
}

double shear_modulus(double poisson) { return kMembraneYoung / (2 * (1 + poisson)); }

/// A stretch along x, one along y, or a shear.
Eigen::Matrix2d plane_strain_of(int which) {
  Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
  const int i = which < 2 ? which : 0;
  const int j = which < 2 ? which : 1;
  strain(i, j) = strain(j, i) = kMembraneStrain;
  return strain;
}

/// Energy of plane stress, J/m3.
double energy_density(double poisson, const Eigen::Matrix2d& strain) {
  const Eigen::Matrix2d stress = kMembraneYoung / (1 - poisson * poisson) *
                                 (poisson * strain.trace() * Eigen::Matrix2d::Identity() + (1 - poisson) * strain);
  return 0.5 * stress.cwiseProduct(strain).sum();
}

using FlatMap = Eigen::Map<const Eigen::VectorXd>;

/// Forces (x, y of each node, N) that hold a membrane in small displacements.
Eigen::VectorXd forces_at(const Membrane& membrane, const Points2& displacements) {
  const Eigen::SparseMatrix<double> stiffness = stiffness_matrix(membrane, false);
  return stiffness.selfadjointView<Eigen::Lower>() * FlatMap(displacements.data(), displacements.size());
}

/// Displacements in equilibrium with the outer nodes displaced as in `uniform`.
Points2 solve_patch(MembraneRun& run, const Points2& uniform) {
  Points2 start = uniform;
  for (int row = 0; row <= run.rows(); ++row) {
    for (int column = 0; column <= run.columns(); ++column) {
      const int node = run.node(column, row);
      const bool is_inner = row > 0 && row < run.rows() && column > 0 && column < run.columns();
      if (is_inner) {
        start.row(node).setZero();
      } else {
        run.clamp(node);
      }
    }
  }
  const Eigen::VectorXd forces = forces_at(run.membrane, start);
  run.loads = -Eigen::Map<const Points2>(forces.data(), run.membrane.node_count(), 2);
  return start + run.displacements();
}

/// The worst of the three strains: the error of the inner displacements, and the energy.
void measure_patch(const Variant& variant, Check& inner, Check& energy) {
  constexpr double kMembraneSide = 0.1;  // of a rectangle along x, m
  constexpr double kFlatness = 0.9;      // its side along y over that
  const Vec2 size(kMembraneSide * variant.counts[0], kFlatness * kMembraneSide * variant.counts[1]);
  inner.measured = 0;
  for (int which = 0; which < 3; ++which) {
    MembraneRun run = make_run(variant, size);
    const Eigen::Matrix2d strain = plane_strain_of(which);
    const Points2 uniform = run.membrane.rest_positions * strain;
    const Points2 moved = solve_patch(run, uniform);
    inner.measured = std::max(inner.measured, (moved - uniform).cwiseAbs().maxCoeff() / uniform.cwiseAbs().maxCoeff());
    const double stored = 0.5 * FlatMap(moved.data(), moved.size()).dot(forces_at(run.membrane, moved));
    const double expected = size.prod() * energy_density(variant.poisson, strain);
    if (which > 0 && std::abs(stored / expected - 1) < std::abs(energy.error())) continue;
    energy.measured = stored;
    energy.expected = expected;
  }
}

}  // namespace

CaseResult run_membrane_stretch(const Choice& choice) {
  const auto measure = [](MembraneRun& run, const Variant& variant, Check& check) {
    stretch(run);
    check.quantity = "end.displacement.x";
    check.measured = run.displacements()(run.node(run.columns(), run.rows()), 0);
    check.expected = kStress / kMembraneYoung * kLength;
    check.source = "stress / E, plane stress";
    if (variant.is_exact()) check.tolerance = kMembraneExact;
  };
  return run_all("membrane_stretch", choice, kUniformRatios, kUniformCounts, measure);
}

CaseResult run_membrane_shear(const Choice& choice) {
  const auto measure = [](MembraneRun& run, const Variant& variant, Check& check) {
    shear(run);
    check.quantity = "top.displacement.x";
    check.measured = run.displacements()(run.node(0, run.rows()), 0);
    check.expected = kStress / shear_modulus(variant.poisson) * kHeight;
    check.source = "stress / G";
    if (variant.is_exact()) check.tolerance = kMembraneExact;
  };
  return run_all("membrane_shear", choice, kUniformRatios, kUniformCounts, measure);
}

CaseResult run_membrane_cantilever(const Choice& choice) {
  const auto measure = [](MembraneRun& run, const Variant& variant, Check& check) {
    hang(run);
    const Points2 moved = run.displacements();
    check.quantity = "tip.displacement.y";
    check.measured = (moved(run.node(run.columns(), 0), 1) + moved(run.node(run.columns(), run.rows()), 1)) / 2;
    // For a width of 1 m and a weight of 1 N/m3: w L^4 / (8 E I) + 6/5 w L^2 / (2 G A).
    check.expected = -(12 * std::pow(kLength, 4) / (8 * kMembraneYoung * kHeight * kHeight) +
                       1.2 * kLength * kLength / (2 * shear_modulus(variant.poisson)));
    check.source = "Timoshenko beam, its clamped section free to warp";
    if (variant.model == RectangleModel::kCalibrated && variant.poisson == 0) check.tolerance = kBeamTolerance;
  };
  return run_all("membrane_cantilever", choice, {0, 0.3}, {{4, 1}, {8, 2}, {16, 4}, {32, 8}}, measure);
}

CaseResult run_membrane_patch(const Choice& choice) {
  std::mt19937 random(kMembraneSeed);
  std::vector<double> ratios{-0.2, 0, 0.1, 0.25, 0.3, kThird, 0.4, 0.49};
  if (choice.poisson) ratios = {*choice.poisson};
  CaseResult result;
  for (const double poisson : ratios) {
    const Counts drawn{2 + int(random() % 4), 2 + int(random() % 4)};
    for (const RectangleModel model : rectangle_models(choice.model)) {
      const Variant variant{model, poisson, chosen_counts(choice, {drawn}).front()};
      Check inner = check_of("membrane_patch", variant);
      Check energy = inner;
      inner.quantity = "inner.displacement";
      inner.source = "a uniform strain, error over the largest displacement";
      energy.quantity = "energy";
      energy.unit = 'J';
      energy.source = "plane stress, energy = stress : strain / 2 x area x 1 m";
      try {
        measure_patch(variant, inner, energy);
        inner.tolerance = kMembraneExact;
        if (variant.is_exact()) energy.tolerance = kMembraneExact;
      } catch (const Error& error) {
        inner.measured = energy.measured = kNaN;
        inner.trouble = energy.trouble = error.what();
      }
      result.checks.push_back(inner);
      result.checks.push_back(energy);
    }
  }
  return result;
}

CasePicture draw_membrane_stretch() { return draw(stretch, 10); }
CasePicture draw_membrane_shear() { return draw(shear, 5); }
CasePicture draw_membrane_cantilever() { return draw(hang, 20); }

}  // namespace sprung
