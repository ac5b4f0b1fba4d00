#include <utility>

#include "app/validate/cases.h"
#include "app/validate/cut_parts.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"

namespace sprung {

CutPart probed_part(const Scene& scene, const std::string& bricks, int axis, CutFigure figure) {
  const auto probed = [=](Model model) {
    Scene chosen = scene;
    chosen.bodies[0].model = model;
    const Observer silent;
    Simulation simulation = prepare_simulation(chosen, silent);
    return std::vector{simulate(simulation, chosen, silent).probes.at(0).samples.back().displacement[axis]};
  };
  return {bricks, scene.bodies[0].material.poisson, {std::move(figure)}, probed};
}

SupportedBody supported_at(const Body& body, int axis, const Vec3& acceleration) {
  SupportedBody supported{.supports = Supports(body.node_count()), .loads = body.masses * acceleration.transpose()};
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node][axis] == 0) supported.supports.fix(node);
  }
  return supported;
}

CaseResult run_cut(const Choice& choice, const Observer& observer) {
  CaseResult result;
  if (choice.bricks || choice.poisson) return result;  // each has its own
  const Model model = choice.model.value_or(Model::kCalibrated);
  std::vector<CutPart> parts;
  for (const auto& some : {thin_parts(), turned_parts(), strained_parts()}) {
    parts.insert(parts.end(), some.begin(), some.end());
  }
  for (const CutPart& part : parts) {
    observer.check_interrupt();
    std::vector<double> measured(part.figures.size(), kNaN);
    std::string trouble;
    try {
      measured = part.measure(model);
    } catch (const Error& error) {
      trouble = error.what();
    }
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const CutFigure& figure = part.figures[i];
      result.checks.push_back({.experiment = "cut",
                               .quantity = figure.quantity,
                               .model = std::string(model_name(model)),
                               .poisson = part.poisson,
                               .grid = part.bricks,
                               .measured = measured[i],
                               .expected = figure.expected,
                               .unit = figure.unit,
                               .source = figure.source,
                               .tolerance = model == Model::kCalibrated ? figure.tolerance : kNaN,
                               .trouble = trouble});
    }
  }
  return result;
}

}  // namespace sprung
