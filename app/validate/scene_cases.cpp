#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "app/scene/scene_file.h"
#include "app/validate/cases.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "core/text.h"
#include "core/units.h"
#include "render/image/legend.h"

namespace sprung {
namespace {

constexpr double kAsGood = 1e-3;             // relative difference below which two errors are equally good
constexpr double kShownDisplacement = 0.15;  // over the body's size; smaller displacements are magnified in pictures

/// One run of the scene.
struct BrickVariant {
  Model model;
  double poisson;
  int bricks;
};

template <class Value>
std::vector<Value> values_to_run(const std::optional<Value>& choice, const std::vector<Value>& varied,
                                 const Value& own) {
  if (choice) return {*choice};
  return varied.empty() ? std::vector<Value>{own} : varied;
}

template <class Value>
bool contains(const std::vector<Value>& list, const Value& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// An empty list does not restrict.
template <class Value>
bool allows(const std::vector<Value>& list, const Value& value) {
  return list.empty() || contains(list, value);
}

bool applies(const Expectation& expectation, const BrickVariant& variant) {
  return allows(expectation.models, variant.model) && allows(expectation.poisson, variant.poisson) &&
         allows(expectation.bricks, variant.bricks);
}

bool applies(const Gate& gate, const BrickVariant& variant) {
  const bool has_model =
      gate.models.empty() ? variant.model == Model::kCalibrated : contains(gate.models, variant.model);
  return has_model && allows(gate.bricks, variant.bricks);
}

/// Bricks along the longest side.
int own_bricks(const SceneBody& body) {
  const double longest = body.box ? body.box->maxCoeff() : body.size.value_or(kDefaultSize);
  const BrickCount count = body.bricks.value_or(kDefaultBricks);
  if (count.is_auto()) throw Error(ErrorKind::kBadInput, "an experiment needs a number of bricks, not \"auto\"");
  return body.brick_size ? int(std::lround(longest / *body.brick_size)) : count.along;
}

Film with_variant(Film scene, const BrickVariant& variant) {
  for (SceneBody& body : scene.bodies) {
    body.model = variant.model;
    body.material.poisson = variant.poisson;
    body.bricks = variant.bricks;
    body.brick_size.reset();
    for (Region& region : body.regions) region.material.poisson = variant.poisson;
  }
  return scene;
}

Eigen::Vector3i grid_counts(const Film& film, const BrickVariant& variant) {
  const SceneBody& body = film.bodies.front();
  if (!body.box) return Eigen::Vector3i::Constant(variant.bricks);
  return (*body.box * variant.bricks / body.box->maxCoeff()).array().round().cast<int>();
}

struct Measurement {
  double value;
  std::string_view unit;
};

/// The quantity in the last frame: "PROBE.displacement.y" (position, force, torque, stress.xx, shear_stress.xy),
/// "PROBE.volume" and so on,
/// "frequency.1" or "nodes.max_error" (mean_error, rms_error).
Measurement measure(const Recording& recording, const std::optional<NodeErrors>& errors, const std::string& quantity) {
  const auto dot = std::min(quantity.rfind('.'), quantity.size());
  const std::string start = quantity.substr(0, dot);
  const std::string end = quantity.substr(std::min(dot + 1, quantity.size()));
  if (start == "nodes" && errors) {
    if (end == "mean_error") return {100 * errors->mean_error(), "%"};
    if (end == "max_error") return {100 * errors->max_error(), "%"};
    if (end == "rms_error") return {100 * errors->rms_error(), "%"};
  }
  if (start == "frequency") {
    const int mode = parse_whole(end);
    if (mode >= 1 && mode <= recording.frequencies.size()) return {recording.frequencies[mode - 1], "Hz"};
  }
  for (const ProbeTrack& track : recording.probes) {
    for (const ProbeQuantity& known : kProbeQuantities) {
      if (!known.is_of(track.kind)) continue;
      for (std::size_t i = 0; i < known.size(); ++i) {
        if (quantity != fmt::format("{}.{}", track.name, known.label(i))) continue;
        return {known.of(track.samples.back())[i], known.unit};
      }
    }
  }
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("expect.quantity: the scene measures no '{}'; write PROBE.displacement.y (or position, force, "
                  "torque), PROBE.stress.xx, PROBE.shear_stress.xy, PROBE.volume (or elastic_energy, max_stress and "
                  "so on) of a part, frequency.1 with solver.scheme modes, or "
                  "nodes.max_error (or mean_error, rms_error) with "
                  "experiment.nodes",
                  quantity));
}

/// The result of a run; only `trouble` if it failed.
struct Outcome {
  std::optional<Recording> recording;
  std::optional<NodeErrors> node_errors;
  std::string trouble;
};

/// Collects the checks of an experiment run by run.
class Runs {
 public:
  Runs(const std::string& name, const Film& film, const Observer& observer)
      : name_(name), film_(film), observer_(observer) {
    if (!film.experiment.nodes.empty()) known_ = read_known_solutions(film.experiment.nodes);
  }

  /// With `is_chosen`, quantities that no expectation covers are reported as well.
  void run(const BrickVariant& variant, bool is_chosen) {
    observer_.check_interrupt();
    const Outcome outcome = simulate_variant(variant);
    std::vector<std::string> seen;
    for (const Expectation& expectation : film_.expectations) {
      if (!applies(expectation, variant)) continue;
      seen.push_back(expectation.quantity);
      add_expected(expectation, variant, outcome);
    }
    for (const Expectation& expectation : film_.expectations) {
      const std::string& quantity = expectation.quantity;
      if (!is_chosen || contains(seen, quantity)) continue;
      seen.push_back(quantity);
      if (quantity.starts_with("nodes.") && !outcome.node_errors) continue;
      add_check(quantity, variant, outcome).source = "no expected value";
    }
    if (outcome.node_errors) result_.node_errors.push_back(*outcome.node_errors);
  }

  CaseResult finish() {
    for (const auto& [index, rival] : rivals_) {
      Check& check = result_.checks[index];
      for (const Check& other : result_.checks) {
        const bool is_same_run = other.quantity == check.quantity && other.poisson == check.poisson &&
                                 other.grid == check.grid && other.expected == check.expected;
        if (!is_same_run || other.model != model_name(rival)) continue;
        check.tolerance = std::fmin(check.tolerance, std::abs(other.error()) * (1 + kAsGood));
      }
    }
    return std::move(result_);
  }

 private:
  Outcome simulate_variant(const BrickVariant& variant) {
    const Observer silent;
    Outcome outcome;
    try {
      const Film film = with_variant(film_, variant);
      Simulation simulation = prepare_simulation(film, silent);
      outcome.recording = simulate(simulation, film, silent);
      const auto& body = simulation.world.bodies.front();
      for (const KnownSolution& known : known_) {
        if (known.poisson != variant.poisson) continue;
        NodeErrors& errors =
            outcome.node_errors.emplace(node_errors(body, simulation.origins.front().bricks_from_rest, known));
        errors.model = model_name(variant.model);
        errors.poisson = variant.poisson;
        errors.grid = grid_text(variant);
      }
    } catch (const Error& error) {
      outcome.recording.reset();
      outcome.trouble = error.what();
      observer_.detail(
          fmt::format("{}, {}, nu {}: {}", name_, model_name(variant.model), variant.poisson, error.what()));
    }
    return outcome;
  }

  [[nodiscard]] std::string grid_text(const BrickVariant& variant) const {
    const Eigen::Vector3i counts = grid_counts(film_, variant);
    return fmt::format("{}x{}x{}", counts.x(), counts.y(), counts.z());
  }

  Check& add_check(const std::string& quantity, const BrickVariant& variant, const Outcome& outcome) {
    Check& check = result_.checks.emplace_back();
    check.experiment = name_;
    check.quantity = quantity;
    check.model = model_name(variant.model);
    check.poisson = variant.poisson;
    check.grid = grid_text(variant);
    check.bricks_across = grid_counts(film_, variant).minCoeff();
    check.expected = kNaN;
    check.trouble = outcome.trouble;
    if (!outcome.recording) return check;
    const Measurement measured = measure(*outcome.recording, outcome.node_errors, quantity);
    check.measured = measured.value;
    check.unit = measured.unit;
    return check;
  }

  void add_expected(const Expectation& expectation, const BrickVariant& variant, const Outcome& outcome) {
    Check& check = add_check(expectation.quantity, variant, outcome);
    check.expected = expectation.value;
    check.source = expectation.source;
    for (const Gate& gate : expectation.gates) {
      if (!applies(gate, variant)) continue;
      if (gate.tolerance) check.tolerance = std::fmin(check.tolerance, *gate.tolerance);
      if (gate.no_worse_than) rivals_.emplace_back(result_.checks.size() - 1, *gate.no_worse_than);
    }
  }

  const std::string& name_;
  const Film& film_;
  const Observer& observer_;
  std::vector<KnownSolution> known_;
  CaseResult result_;
  std::vector<std::pair<std::size_t, Model>> rivals_;  // checks whose tolerance is the error of another model
};

CaseResult run_experiment(const std::string& name, const Film& film, const Choice& choice, const Observer& observer) {
  const SceneBody& body = film.bodies.front();
  const Experiment& varied = film.experiment;
  Runs runs(name, film, observer);
  for (const double poisson : values_to_run(choice.poisson, varied.poisson, body.material.poisson)) {
    for (const Model model : values_to_run(choice.model, varied.models, body.model)) {
      for (const int bricks : values_to_run(choice.bricks, varied.bricks, own_bricks(body))) {
        runs.run({.model = model, .poisson = poisson, .bricks = bricks}, choice.is_any());
      }
    }
  }
  return runs.finish();
}

/// The scene on its middle grid with a Poisson's ratio of its experiment; of modes, the first one at its peak.
CasePicture draw_scene(Film scene) {
  SceneBody& drawn = scene.bodies.front();
  const std::vector<int>& grids = scene.experiment.bricks;
  const std::vector<double>& ratios = scene.experiment.poisson;
  if (!grids.empty()) drawn.bricks = grids[grids.size() / 2];
  if (!allows(ratios, drawn.material.poisson)) drawn.material.poisson = ratios.front();
  if (scene.solver.scheme == Solver::kModes) {
    scene.solver.modes = 1;
    scene.duration = 4 / scene.fps;
  }
  const Observer silent;
  Simulation simulation = prepare_simulation(scene, silent);
  static_cast<void>(simulate(simulation, scene, silent));
  const Body& body = simulation.world.bodies.front();
  const double largest = (body.positions - body.rest_positions).rowwise().norm().maxCoeff();
  const double wanted = largest > 0 ? kShownDisplacement * simulation.size / largest : 1;
  const double magnification = std::max(1.0, round_length(wanted));
  return {draw_body(body, {.magnification = magnification}),
          fmt::format("{}, ν = {}{}", count_of(body.grid.brick_count(), "brick"), drawn.material.poisson,
                      magnification > 1 ? fmt::format(", displacements magnified {:g} times", magnification) : "")};
}

}  // namespace

Case scene_case(const std::filesystem::path& file) {
  const auto scene = std::make_shared<const Film>(read_scene(file));
  if (scene->expectations.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the scene expects nothing; give it [[expect]] with quantity, value and source",
                            file.string()));
  }
  const std::string name = file.stem().string();
  return {.name = name,
          .title = scene->experiment.title,
          .about = scene->experiment.about,
          .run = [=](const Choice& choice,
                     const Observer& observer) { return run_experiment(name, *scene, choice, observer); },
          .draw = [=] { return draw_scene(*scene); }};
}

}  // namespace sprung
