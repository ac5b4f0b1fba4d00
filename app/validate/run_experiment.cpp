#include "app/validate/run_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "app/console/interrupt.h"
#include "app/validate/quantity.h"
#include "core/error.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"

namespace sprung {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kAsGood = 1e-3;  // errors that differ by less than that share of themselves are equally good

/// One run of the scene.
struct Variant {
  Model model;
  double poisson;
  int bricks;
};

template <class Value>
std::vector<Value> choose(const std::optional<Value>& choice, const std::vector<Value>& varied, const Value& own) {
  if (choice) return {*choice};
  return varied.empty() ? std::vector<Value>{own} : varied;
}

template <class Value>
bool speaks_of(const std::vector<Value>& list, const Value& value) {
  return list.empty() || std::find(list.begin(), list.end(), value) != list.end();
}

bool applies(const Expectation& expectation, const Variant& variant) {
  return speaks_of(expectation.models, variant.model) && speaks_of(expectation.poisson, variant.poisson) &&
         speaks_of(expectation.bricks, variant.bricks);
}

bool applies(const Gate& gate, const Variant& variant) {
  const bool is_asked =
      gate.models.empty() ? variant.model == Model::kCalibrated : speaks_of(gate.models, variant.model);
  return is_asked && speaks_of(gate.bricks, variant.bricks);
}

/// Bricks along the longest side.
int own_bricks(const SceneBody& body) {
  const double longest = body.box ? body.box->maxCoeff() : body.size.value_or(kDefaultSize);
  const BrickCount count = body.bricks.value_or(kDefaultBricks);
  if (count.is_auto()) throw Error(ErrorKind::kBadInput, "an experiment needs a number of bricks, not \"auto\"");
  return body.brick_size ? int(std::lround(longest / *body.brick_size)) : count.along;
}

Film with_variant(Film scene, const Variant& variant) {
  for (SceneBody& body : scene.bodies) {
    body.model = variant.model;
    body.material.poisson = variant.poisson;
    for (Region& region : body.regions) region.material.poisson = variant.poisson;
    body.bricks = variant.bricks;
    body.brick_size.reset();
    for (Region& region : body.regions) region.material.poisson = variant.poisson;
  }
  return scene;
}

Eigen::Vector3i grid_counts(const Film& scene, const Variant& variant) {
  const SceneBody& body = scene.bodies.front();
  if (!body.box) return Eigen::Vector3i::Constant(variant.bricks);
  return (*body.box * variant.bricks / body.box->maxCoeff()).array().round().cast<int>();
}

std::string grid_text(const Eigen::Vector3i& counts) {
  return fmt::format("{}x{}x{}", counts.x(), counts.y(), counts.z());
}

/// What a run left behind; nothing but the trouble where it could not be carried through.
struct Outcome {
  std::optional<Recording> recording;
  std::optional<NodeErrors> node_errors;
  std::string trouble;
};

/// Smallest volume ratio of any brick in any frame; leaves the bodies in the last one.
double most_crushed(Simulation& simulation, const Recording& recording) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::vector<Floats3>& frame : recording.frames) {
    for (std::size_t actor = 0; actor < frame.size(); ++actor) {
      Body& body = simulation.world.bodies[actor];
      body.positions = frame[actor].cast<double>();
      smallest = std::min(smallest, smallest_volume_ratio(body));
    }
  }
  return smallest;
}

/// The experiment's checks, run after run.
class Runs {
 public:
  Runs(const std::string& name, const Film& scene, bool is_chosen, const Console& console)
      : name_(name), scene_(scene), is_chosen_(is_chosen), console_(console) {
    silent_.quiet = true;
    if (!scene.experiment.nodes.empty()) known_ = read_known_solutions(scene.experiment.nodes);
  }

  void run(const Variant& variant) {
    stop_if_interrupted();
    const Outcome outcome = outcome_of(variant);
    for (const Expectation& expectation : scene_.expectations) {
      if (applies(expectation, variant)) add(expectation, variant, outcome);
    }
    if (is_chosen_) add_unexpected(variant, outcome);
    if (outcome.node_errors) result_.node_errors.push_back(*outcome.node_errors);
  }

  CaseResult finish() {
    for (const auto& [check, rival] : rivals_) {
      for (const Check& other : result_.checks) {
        if (is_same_run(result_.checks[check], other) && other.model == model_name(rival)) {
          double& tolerance = result_.checks[check].tolerance;
          tolerance = std::fmin(tolerance, std::abs(other.error()) * (1 + kAsGood));
        }
      }
    }
    std::set<std::string, std::less<>> gated;  // models; the others are shown as they are
    for (const Check& check : result_.checks) {
      if (check.is_gate()) gated.insert(check.model);
    }
    for (const auto& [model, crushed] : most_crushed_) {
      add_guard(crushed, gated.empty() || gated.count(model_name(model)) > 0);
    }
    return std::move(result_);
  }

 private:
  struct Crushed {
    Variant variant;
    double volume;  // over the volume at rest
    double bound;
  };

  static bool is_same_run(const Check& a, const Check& b) {
    return a.quantity == b.quantity && a.poisson == b.poisson && a.grid == b.grid && a.expected == b.expected;
  }

  Outcome outcome_of(const Variant& variant) {
    Outcome outcome;
    try {
      const Film scene = with_variant(scene_, variant);
      Simulation simulation = prepare_simulation(scene, silent_);
      outcome.recording = simulate(simulation, scene, silent_);
      compare_nodes(simulation, variant, outcome);
      note_volume(simulation, variant, *outcome.recording);
    } catch (const Error& error) {
      outcome.recording.reset();
      outcome.trouble = error.what();
      console_.detail(
          fmt::format("{}, {}, nu {}: {}", name_, model_name(variant.model), variant.poisson, error.what()));
    }
    return outcome;
  }

  void compare_nodes(const Simulation& simulation, const Variant& variant, Outcome& outcome) const {
    for (const KnownSolution& known : known_) {
      if (known.poisson != variant.poisson) continue;
      const Mat3& turn = simulation.world.bodies.front().origin.bricks_from_rest;
      NodeErrors& errors = outcome.node_errors.emplace(node_errors(simulation.world.bodies.front(), turn, known));
      errors.model = model_name(variant.model);
      errors.poisson = variant.poisson;
      errors.grid = grid_text(grid_counts(scene_, variant));
    }
  }

  void note_volume(Simulation& simulation, const Variant& variant, const Recording& recording) {
    if (variant.model == Model::kFem) return;
    const double bound = simulation.world.bodies.front().law.guard_ratio;
    const Crushed now{.variant = variant, .volume = most_crushed(simulation, recording), .bound = bound};
    const auto [place, is_new] = most_crushed_.try_emplace(variant.model, now);
    if (now.volume < place->second.volume) place->second = now;
  }

  Check& add_check(const std::string& quantity, const Variant& variant, const Outcome& outcome) {
    const Eigen::Vector3i counts = grid_counts(scene_, variant);
    Check& check = result_.checks.emplace_back();
    check.experiment = name_;
    check.quantity = quantity;
    check.model = model_name(variant.model);
    check.poisson = variant.poisson;
    check.grid = grid_text(counts);
    check.bricks_across = counts.minCoeff();
    check.measured = kNone;
    check.expected = kNone;
    check.tolerance = kNone;
    check.trouble = outcome.trouble;
    if (!outcome.recording) return check;
    const NodeErrors* errors = outcome.node_errors ? &*outcome.node_errors : nullptr;
    const Quantity measured = measure(*outcome.recording, errors, quantity);
    check.measured = measured.value;
    check.unit = measured.unit;
    return check;
  }

  void add(const Expectation& expectation, const Variant& variant, const Outcome& outcome) {
    Check& check = add_check(expectation.quantity, variant, outcome);
    check.expected = expectation.value;
    check.source = expectation.source;
    for (const Gate& gate : expectation.gates) {
      if (!applies(gate, variant)) continue;
      if (gate.tolerance) check.tolerance = std::fmin(check.tolerance, *gate.tolerance);
      if (gate.no_worse_than) rivals_.emplace_back(result_.checks.size() - 1, *gate.no_worse_than);
    }
  }

  /// What nothing is known to compare with at the ratio or on the grid that a person chose.
  void add_unexpected(const Variant& variant, const Outcome& outcome) {
    std::vector<std::string> seen;
    for (const Expectation& expectation : scene_.expectations) {
      if (applies(expectation, variant)) seen.push_back(expectation.quantity);
    }
    for (const Expectation& expectation : scene_.expectations) {
      const std::string& quantity = expectation.quantity;
      if (std::find(seen.begin(), seen.end(), quantity) != seen.end()) continue;
      seen.push_back(quantity);
      if (quantity.starts_with("nodes.") && !outcome.node_errors) continue;
      add_check(quantity, variant, outcome).source = "nothing known to compare with";
    }
  }

  void add_guard(const Crushed& crushed, bool is_gate) {
    Check& check = add_check("smallest.volume", crushed.variant, {});
    check.measured = crushed.volume;
    check.expected = crushed.bound;
    check.is_least = true;
    if (is_gate) check.tolerance = 0;
    check.source =
        "the guard acts on bricks of less than this share of their volume at rest; the worst run of the model";
  }

  const std::string& name_;
  const Film& scene_;
  bool is_chosen_;
  const Console& console_;
  Console silent_;
  std::vector<KnownSolution> known_;
  CaseResult result_;
  std::vector<std::pair<std::size_t, Model>> rivals_;  // checks whose tolerance is another model's error
  std::map<Model, Crushed> most_crushed_;
};

}  // namespace

CaseResult run_experiment(const std::string& name, const Film& scene, const Choice& choice, const Console& console) {
  const SceneBody& body = scene.bodies.front();
  const bool is_chosen = choice.model || choice.poisson || choice.bricks;
  Runs runs(name, scene, is_chosen, console);
  for (const double poisson : choose(choice.poisson, scene.experiment.poisson, body.material.poisson)) {
    for (const Model model : choose(choice.model, scene.experiment.models, body.model)) {
      for (const int bricks : choose(choice.bricks, scene.experiment.bricks, own_bricks(body))) {
        runs.run({.model = model, .poisson = poisson, .bricks = bricks});
      }
    }
  }
  return runs.finish();
}

}  // namespace sprung
