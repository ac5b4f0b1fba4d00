#include "app/validate/make_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "app/interrupt.h"
#include "app/make_production.h"
#include "app/progress.h"
#include "app/report/html_report.h"
#include "app/report/plots.h"
#include "app/simulate.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kShownSwing = 0.15;  // of the body's size: smaller displacements are drawn larger

/// The same scene with its middle grid, and of modes the first one at its widest.
Scene scene_to_draw(Scene scene) {
  const std::vector<int>& grids = scene.experiment.bricks;
  if (!grids.empty()) scene.bodies.front().bricks = grids[grids.size() / 2];
  if (scene.solver.scheme == Solver::kModes) {
    scene.solver.modes = 1;
    scene.duration = 4 / scene.fps;
  }
  return scene;
}

/// 1, 2, 5, 10, 20 ...: the largest that does not draw the displacements too large.
double magnification_of(const Body& body, double size) {
  const double largest = (body.positions - body.rest_positions).rowwise().norm().maxCoeff();
  if (!(largest > 0) || largest >= kShownSwing * size) return 1;
  const double most = kShownSwing * size / largest;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  return std::max(1.0, decade * (most >= 5 * decade ? 5 : most >= 2 * decade ? 2 : 1));
}

ReportPicture picture_of(const NamedScene& experiment) {
  const Console silent{.quiet = true};
  const Scene scene = scene_to_draw(experiment.scene);
  Production production = make_production(scene, silent);
  static_cast<void>(simulate(production, scene, silent));
  const Body& body = production.world.actors.front().body;
  const double magnification = magnification_of(body, production.size);
  ExperimentPicture drawn = draw_experiment(body, {.magnification = magnification});
  const std::string caption =
      fmt::format("{} bricks, nu = {}{}", body.grid.brick_count(), scene.bodies.front().material.poisson,
                  magnification > 1 ? fmt::format(", displacements drawn {:g} times as large", magnification) : "");
  return {.experiment = experiment.name,
          .caption = caption,
          .image = std::move(drawn.image),
          .colors = std::move(drawn.colors)};
}

std::vector<Check> checks_of(const std::vector<Check>& checks, std::string_view experiment) {
  std::vector<Check> chosen;
  for (const Check& check : checks) {
    if (check.experiment == experiment) chosen.push_back(check);
  }
  return chosen;
}

}  // namespace

void make_report(const std::filesystem::path& folder, const std::vector<NamedScene>& experiments,
                 const std::vector<Check>& checks, double seconds, const Console& console) {
  Progress progress(console, "report", static_cast<double>(experiments.size()));
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw Error(ErrorKind::kFailed, fmt::format("cannot make the folder '{}'", folder.string()));
  Report report{.checks = checks,
                .made = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr))),
                .seconds = seconds};
  for (const NamedScene& experiment : experiments) {
    stop_if_interrupted();
    report.experiments.push_back({.name = experiment.name, .title = experiment.scene.experiment.title});
    report.pictures.push_back(picture_of(experiment));
    progress.update(static_cast<double>(report.experiments.size()));
  }
  const std::vector<Check> cantilever = checks_of(checks, "cantilever");
  if (!cantilever.empty()) {
    const Figure convergence = convergence_figure(cantilever);
    write_svg(convergence, folder / "convergence.svg");
    report.plots.push_back(
        {.caption = "Error of the tip's deflection over the bricks across the beam", .figure = convergence});
  }
  report.plots.push_back({.caption = "Towards a Poisson's ratio of 1/2", .figure = incompressibility_figure()});
  report.plots.push_back(
      {.caption = "Large strain: the brick as a hyperelastic law", .figure = stress_stretch_figure()});
  write_html_report(report, folder / "report.html");
  progress.finish((folder / "report.html").string());
}

}  // namespace sprung
