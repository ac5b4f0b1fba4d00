#include <fmt/format.h>

#include <cmath>

#include "app/validate/built_in_cases.h"
#include "app/validate/membrane_run.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kLength = 0.4;  // m
constexpr double kHeight = 0.1;  // m
constexpr double kYoung = 1000;  // Pa, of membrane_material()
constexpr double kStress = 10;   // Pa, of stretch and shear
constexpr double kExact = 1e-9;
constexpr double kBeamTolerance = 0.01;
constexpr double kThird = 1.0 / 3;

MembraneRun make_run(const MembraneCounts& counts, RectangleModel model, double poisson) {
  return {counts, {kLength, kHeight}, model, poisson};
}

std::vector<double> ratios(const Choice& choice, std::vector<double> varied) {
  return choice.poisson ? std::vector<double>{*choice.poisson} : std::move(varied);
}

/// A check for each model, ratio and grid; `measure` fills in what it measures and expects.
template <class Measure>
CaseResult run_all(std::string_view experiment, const Choice& choice, const std::vector<double>& varied_ratios,
                   const std::vector<MembraneCounts>& varied_counts, const Measure& measure) {
  CaseResult result;
  for (const double poisson : ratios(choice, varied_ratios)) {
    for (const MembraneModel& model : membrane_models(choice)) {
      for (const MembraneCounts& counts : membrane_counts(choice, varied_counts)) {
        Check check = membrane_check(experiment, model, poisson, counts);
        check.unit = 'm';
        try {
          MembraneRun run = make_run(counts, model.model, poisson);
          measure(run, model.model, poisson, check);
        } catch (const Error& error) {
          check.trouble = error.what();
        }
        result.checks.push_back(check);
      }
    }
  }
  return result;
}

/// The second and third grid have rectangles that are not square.
const std::vector<MembraneCounts> kPatchCounts{{4, 1}, {5, 1}, {10, 2}};
const std::vector<double> kPatchRatios{0, 0.1, kThird, 0.45};

/// Two sides roll on axes of symmetry, the far end is pulled.
void stretch(MembraneRun& run) {
  for (int row = 0; row <= run.rows(); ++row) run.membrane().fix(run.node(0, row), 0);
  for (int column = 0; column <= run.columns(); ++column) run.membrane().fix(run.node(column, 0), 1);
  run.pull_column(run.columns(), {kStress, 0});
}

/// Tractions along all four sides; the bottom neither rises nor turns.
void shear(MembraneRun& run) {
  run.membrane().fix(run.node(0, 0), 0);
  run.membrane().fix(run.node(0, 0), 1);
  run.membrane().fix(run.node(run.columns(), 0), 1);
  run.pull_column(run.columns(), {0, kStress});
  run.pull_column(0, {0, -kStress});
  run.pull_row(run.rows(), {kStress, 0});
  run.pull_row(0, {-kStress, 0});
}

/// One end held, the weight pulls.
void hang(MembraneRun& run) {
  for (int row = 0; row <= run.rows(); ++row) {
    run.membrane().fix(run.node(0, row), 0);
    run.membrane().fix(run.node(0, row), 1);
  }
  run.loads().col(1) = -run.membrane().masses;
}

/// Deflection (m) of a beam 1 m wide under 1 N/m3, by Timoshenko: w L^4 / (8 E I) + 6/5 w L^2 / (2 G A).
double timoshenko(double poisson) {
  const double shear = kYoung / (2 * (1 + poisson));
  return -(12 * std::pow(kLength, 4) / (8 * kYoung * kHeight * kHeight) + 1.2 * kLength * kLength / (2 * shear));
}

/// A membrane after its load, drawn larger than life.
ReportPicture draw(void (*load)(MembraneRun&), double magnification) {
  MembraneRun run = make_run({16, 4}, RectangleModel::kCalibrated, 0.3);
  load(run);
  run.membrane().positions += run.displacements();
  ExperimentPicture drawn = draw_experiment(run.membrane(), {.magnification = magnification});
  return {.experiment = "",
          .caption = fmt::format("16×4 rectangles, ν = 0.3, displacements drawn {:g} times as large", magnification),
          .image = std::move(drawn.image),
          .colors = std::move(drawn.colors)};
}

}  // namespace

CaseResult run_membrane_stretch(const Choice& choice) {
  const auto measure = [](MembraneRun& run, RectangleModel model, double poisson, Check& check) {
    stretch(run);
    check.quantity = "end.displacement.x";
    check.measured = run.displacements()(run.node(run.columns(), run.rows()), 0);
    check.expected = kStress / kYoung * kLength;
    check.source = "stress / E, plane stress";
    if (is_exact(model, poisson)) check.tolerance = kExact;
  };
  return run_all("membrane_stretch", choice, kPatchRatios, kPatchCounts, measure);
}

CaseResult run_membrane_shear(const Choice& choice) {
  const auto measure = [](MembraneRun& run, RectangleModel model, double poisson, Check& check) {
    shear(run);
    check.quantity = "top.displacement.x";
    check.measured = run.displacements()(run.node(0, run.rows()), 0);
    check.expected = kStress / (kYoung / (2 * (1 + poisson))) * kHeight;
    check.source = "stress / G";
    if (is_exact(model, poisson)) check.tolerance = kExact;
  };
  return run_all("membrane_shear", choice, kPatchRatios, kPatchCounts, measure);
}

CaseResult run_membrane_cantilever(const Choice& choice) {
  const auto measure = [](MembraneRun& run, RectangleModel model, double poisson, Check& check) {
    hang(run);
    const Points2 moved = run.displacements();
    check.quantity = "tip.displacement.y";
    check.measured = (moved(run.node(run.columns(), 0), 1) + moved(run.node(run.columns(), run.rows()), 1)) / 2;
    check.expected = timoshenko(poisson);
    check.source = "Timoshenko beam, without the clamp's hold on the section";
    if (model == RectangleModel::kCalibrated && poisson == 0) check.tolerance = kBeamTolerance;
  };
  return run_all("membrane_cantilever", choice, {0, 0.3}, {{4, 1}, {8, 2}, {16, 4}, {32, 8}}, measure);
}

ReportPicture draw_membrane_stretch() { return draw(stretch, 10); }
ReportPicture draw_membrane_shear() { return draw(shear, 5); }
ReportPicture draw_membrane_cantilever() { return draw(hang, 20); }

}  // namespace sprung
