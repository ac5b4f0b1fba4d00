#include "app/validate/sheet_experiments.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/body/sheet.h"
#include "core/motion/sheet_statics.h"

namespace sprung {
namespace {

constexpr double kLength = 0.4;  // m
constexpr double kHeight = 0.1;  // m
constexpr double kYoung = 1000;  // Pa
constexpr double kStress = 10;   // Pa, of stretch and shear
constexpr double kExact = 1e-9;
constexpr double kBeamTolerance = 0.01;

constexpr std::array<std::pair<RectangleModel, std::string_view>, 3> kModels{
    {{RectangleModel::kCalibrated, "2d-calibrated"},
     {RectangleModel::kCorrected, "2d-corrected"},
     {RectangleModel::kPlain, "2d-plain"}}};

/// Columns and rows; the second and third have rectangles that are not square.
using Counts = std::array<int, 2>;

Material material_of(double poisson) {
  Material material;
  material.young = kYoung;
  material.poisson = poisson;
  material.density = 1;
  return material;
}

/// One sheet and what becomes of it under its loads.
class SheetRun {
 public:
  SheetRun(const Counts& counts, RectangleModel model, double poisson)
      : counts_(counts),
        sheet_(make_sheet(counts[0], counts[1], {kLength, kHeight}, model, material_of(poisson))),
        loads_(Points2::Zero(sheet_.node_count(), 2)) {}

  [[nodiscard]] int node(int column, int row) const { return column + row * (counts_[0] + 1); }
  [[nodiscard]] int columns() const { return counts_[0]; }
  [[nodiscard]] int rows() const { return counts_[1]; }
  Sheet& sheet() { return sheet_; }
  Points2& loads() { return loads_; }

  /// A traction (Pa) on the side at that column, and at that row.
  void pull_column(int column, const Vec2& traction) {
    for (int row = 0; row <= rows(); ++row) {
      const double share = row == 0 || row == rows() ? 0.5 : 1;
      loads_.row(node(column, row)) += share * kHeight / rows() * traction.transpose();
    }
  }
  void pull_row(int row, const Vec2& traction) {
    for (int column = 0; column <= columns(); ++column) {
      const double share = column == 0 || column == columns() ? 0.5 : 1;
      loads_.row(node(column, row)) += share * kLength / columns() * traction.transpose();
    }
  }
  [[nodiscard]] Points2 displacements() const { return solve_linear(sheet_, loads_); }

 private:
  Counts counts_;
  Sheet sheet_;
  Points2 loads_;
};

/// A check of that sheet, without its numbers.
Check check_of(std::string_view experiment, std::string_view model, double poisson, const Counts& counts) {
  Check check;
  check.experiment = experiment;
  check.model = model;
  check.poisson = poisson;
  check.grid = fmt::format("{}x{}", counts[0], counts[1]);
  check.bricks_across = counts[1];
  check.unit = 'm';
  return check;
}

/// Whether the six springs alone represent the ratio.
bool is_exact(RectangleModel model, double poisson) {
  return model != RectangleModel::kPlain || std::abs(poisson - 1.0 / 3) < 1e-12;
}

template <class Measure>
std::vector<Check> patch_checks(std::string_view experiment, const Measure& measure) {
  std::vector<Check> checks;
  for (const double poisson : {0.0, 0.1, 1.0 / 3, 0.45}) {
    for (const auto& [model, name] : kModels) {
      for (const Counts& counts : {Counts{4, 1}, Counts{5, 1}, Counts{10, 2}}) {
        SheetRun run(counts, model, poisson);
        Check check = check_of(experiment, name, std::round(poisson * 1e4) / 1e4, counts);
        measure(run, poisson, check);
        check.tolerance = is_exact(model, poisson) ? kExact : std::numeric_limits<double>::quiet_NaN();
        checks.push_back(check);
      }
    }
  }
  return checks;
}

/// Two sides roll on axes of symmetry, the far end is pulled.
std::vector<Check> stretch() {
  return patch_checks("sheet_stretch", [](SheetRun& run, double, Check& check) {
    for (int row = 0; row <= run.rows(); ++row) run.sheet().fix(run.node(0, row), 0);
    for (int column = 0; column <= run.columns(); ++column) run.sheet().fix(run.node(column, 0), 1);
    run.pull_column(run.columns(), {kStress, 0});
    check.quantity = "end.displacement.x";
    check.measured = run.displacements()(run.node(run.columns(), run.rows()), 0);
    check.expected = kStress / kYoung * kLength;
    check.source = "stress / E, plane stress";
  });
}

/// Tractions along all four sides; the bottom neither rises nor turns.
std::vector<Check> shear() {
  return patch_checks("sheet_shear", [](SheetRun& run, double poisson, Check& check) {
    run.sheet().fix(run.node(0, 0), 0);
    run.sheet().fix(run.node(0, 0), 1);
    run.sheet().fix(run.node(run.columns(), 0), 1);
    run.pull_column(run.columns(), {0, kStress});
    run.pull_column(0, {0, -kStress});
    run.pull_row(run.rows(), {kStress, 0});
    run.pull_row(0, {-kStress, 0});
    check.quantity = "top.displacement.x";
    check.measured = run.displacements()(run.node(0, run.rows()), 0);
    check.expected = kStress / (kYoung / (2 * (1 + poisson))) * kHeight;
    check.source = "stress / G";
  });
}

/// Deflection (m) of a beam 1 m wide under 1 N/m3, by Timoshenko: w L^4 / (8 E I) + 6/5 w L^2 / (2 G A).
double timoshenko(double poisson) {
  const double shear = kYoung / (2 * (1 + poisson));
  return -(12 * std::pow(kLength, 4) / (8 * kYoung * kHeight * kHeight) + 1.2 * kLength * kLength / (2 * shear));
}

std::vector<Check> cantilever() {
  std::vector<Check> checks;
  for (const double poisson : {0.0, 0.3}) {
    for (const auto& [model, name] : kModels) {
      for (const Counts& counts : {Counts{4, 1}, Counts{8, 2}, Counts{16, 4}, Counts{32, 8}}) {
        SheetRun run(counts, model, poisson);
        for (int row = 0; row <= run.rows(); ++row) {
          run.sheet().fix(run.node(0, row), 0);
          run.sheet().fix(run.node(0, row), 1);
        }
        run.loads().col(1) = -run.sheet().masses;
        const Points2 moved = run.displacements();
        Check check = check_of("sheet_cantilever", name, poisson, counts);
        check.quantity = "tip.displacement.y";
        check.measured = (moved(run.node(run.columns(), 0), 1) + moved(run.node(run.columns(), run.rows()), 1)) / 2;
        check.expected = timoshenko(poisson);
        check.source = "Timoshenko beam, without the clamp's hold on the section";
        const bool is_gate = model == RectangleModel::kCalibrated && poisson == 0;
        check.tolerance = is_gate ? kBeamTolerance : std::numeric_limits<double>::quiet_NaN();
        checks.push_back(check);
      }
    }
  }
  return checks;
}

constexpr std::array<SheetExperiment, 3> kExperiments{
    {{"sheet_stretch", "the paper's 2D rectangle: uniform stretch, exact at any ratio", stretch},
     {"sheet_shear", "the paper's 2D rectangle: uniform shear, exact at any ratio", shear},
     {"sheet_cantilever", "the paper's 2D rectangle: a cantilever against beam theory", cantilever}}};

}  // namespace

std::span<const SheetExperiment> sheet_experiments() { return kExperiments; }

}  // namespace sprung
