#include "app/validate/make_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "app/console/console.h"
#include "app/console/interrupt.h"
#include "app/report/html_report.h"
#include "app/report/plots.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr double kShownRatio = 0.3;   // Poisson's, of the node errors
constexpr double kShownSwing = 0.15;  // of the body's size: smaller displacements are drawn larger

/// The same scene with its middle grid, at a ratio that it is an experiment on, and of modes the first one at its
/// widest.
Film scene_to_draw(Film scene) {
  const std::vector<int>& grids = scene.experiment.bricks;
  if (!grids.empty()) scene.bodies.front().bricks = grids[grids.size() / 2];
  const std::vector<double>& ratios = scene.experiment.poisson;
  double& own = scene.bodies.front().material.poisson;
  if (!ratios.empty() && std::find(ratios.begin(), ratios.end(), own) == ratios.end()) own = ratios.front();
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

ReportPicture picture_of(const std::string& name, const Film& scene_as_it_is) {
  Console silent;
  silent.quiet = true;
  const Film scene = scene_to_draw(scene_as_it_is);
  Simulation simulation = prepare_simulation(scene, silent);
  static_cast<void>(simulate(simulation, scene, silent));
  const Body& body = simulation.world.bodies.front();
  const double magnification = magnification_of(body, simulation.size);
  ExperimentPicture drawn = draw_experiment(body, {.magnification = magnification});
  const std::string caption =
      fmt::format("{}, ν = {}{}", count_of(body.grid.brick_count(), "brick"), scene.bodies.front().material.poisson,
                  magnification > 1 ? fmt::format(", displacements drawn {:g} times as large", magnification) : "");
  return {.experiment = name, .caption = caption, .image = std::move(drawn.image), .colors = std::move(drawn.colors)};
}

void add_image(const FinishedCase& one, Report& report) {
  if (one.scene != nullptr) {
    report.pictures.push_back(picture_of(one.name, *one.scene));
  } else if (one.built_in->draw != nullptr) {
    ReportPicture picture = one.built_in->draw();
    picture.experiment = one.name;
    report.pictures.push_back(std::move(picture));
  }
}

ReportExperiment described(const FinishedCase& one) {
  if (one.scene != nullptr) {
    return {.name = one.name, .title = one.scene->experiment.title, .what = one.scene->experiment.about};
  }
  return {.name = one.name, .title = std::string(one.built_in->title), .what = std::string(one.built_in->about)};
}

/// The figure goes into the page and beside it.
void add_plot(Report& report, const std::filesystem::path& file, ReportPlot plot) {
  write_svg(plot.figure, file);
  report.plots.push_back(std::move(plot));
}

void add_plots(const std::vector<FinishedCase>& cases, const std::filesystem::path& folder, Report& report) {
  for (const FinishedCase& one : cases) {
    if (one.name == "cantilever") {
      std::vector<Check> tips = one.result.checks;
      std::erase_if(tips, [](const Check& check) { return check.quantity != "tip.displacement.y"; });
      add_plot(
          report, folder / "convergence.svg",
          {.caption = "Error of the tip's deflection over the bricks across the beam. Corrected springs converge to "
                      "the right answer, plain ones to a wrong one unless ν = 1/4.",
           .figure = convergence_figure(tips)});
      add_plot(report, folder / "node_errors.svg",
               {.experiment = one.name,
                .caption = "Every node, as the paper's Figure 5 shows it",
                .figure = node_error_figure(one.result.node_errors, kShownRatio)});
    }
    if (one.name == "uniaxial") {
      add_plot(report, folder / "stress_stretch.svg",
               {.experiment = one.name,
                .caption = "Large strain: the brick as a hyperelastic law",
                .figure = stress_stretch_figure()});
    }
  }
  add_plot(
      report, folder / "incompressibility.svg",
      {.caption = "Towards a Poisson's ratio of 1/2: the hexahedron locks, the brick does not; springs do not keep "
                  "the volume at large strain",
       .figure = incompressibility_figure()});
}

}  // namespace

void make_report(const std::filesystem::path& folder, const std::vector<FinishedCase>& cases, double seconds,
                 const Console& console) {
  Progress progress(console, "report", double(cases.size()));
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw Error(ErrorKind::kFailed, fmt::format("cannot make the folder '{}'", folder.string()));
  Report report{.made = fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time(nullptr))), .seconds = seconds};
  for (const FinishedCase& one : cases) {
    stop_if_interrupted();
    report.checks.insert(report.checks.end(), one.result.checks.begin(), one.result.checks.end());
    report.experiments.push_back(described(one));
    report.tables.push_back({.experiment = one.name, .table = one.result.table});
    add_image(one, report);
    progress.update(double(report.experiments.size()));
  }
  add_plots(cases, folder, report);
  write_html_report(report, folder / "report.html");
  progress.finish((folder / "report.html").string());
}

}  // namespace sprung
