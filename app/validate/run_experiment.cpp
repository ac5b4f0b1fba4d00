#include "app/validate/run_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/interrupt.h"
#include "app/make_production.h"
#include "app/simulate.h"
#include "app/validate/quantity.h"
#include "core/error.h"

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
  return body.brick_size ? static_cast<int>(std::lround(longest / *body.brick_size))
                         : body.bricks.value_or(kDefaultBricks);
}

Scene with_variant(Scene scene, const Variant& variant) {
  for (SceneBody& body : scene.bodies) {
    body.model = variant.model;
    body.material.poisson = variant.poisson;
    for (Region& region : body.regions) region.material.poisson = variant.poisson;
    body.bricks = variant.bricks;
    body.brick_size.reset();
  }
  return scene;
}

Eigen::Vector3i grid_counts(const Scene& scene, const Variant& variant) {
  const SceneBody& body = scene.bodies.front();
  if (!body.box) return Eigen::Vector3i::Constant(variant.bricks);
  return (*body.box * variant.bricks / body.box->maxCoeff()).array().round().cast<int>();
}

/// The experiment's checks, run after run.
class Runs {
 public:
  Runs(const std::string& name, const Scene& scene, bool is_chosen, const Console& console)
      : name_(name), scene_(scene), is_chosen_(is_chosen), console_(console) {
    silent_.quiet = true;
  }

  void run(const Variant& variant) {
    stop_if_interrupted();
    std::optional<Recording> recording;
    std::string trouble;
    try {
      const Scene scene = with_variant(scene_, variant);
      Production production = make_production(scene, silent_);
      recording = simulate(production, scene, silent_);
    } catch (const Error& error) {
      trouble = error.what();
      console_.detail(fmt::format("{}, {}, nu {}: {}", name_, model_name(variant.model), variant.poisson, trouble));
    }
    for (const Expectation& expectation : scene_.expectations) {
      if (applies(expectation, variant)) add(expectation, variant, recording, trouble);
    }
    if (is_chosen_) add_unexpected(variant, recording, trouble);
  }

  std::vector<Check> finish() {
    for (const auto& [check, rival] : rivals_) {
      for (const Check& other : checks_) {
        if (is_same_run(checks_[check], other) && other.model == model_name(rival)) {
          checks_[check].tolerance = std::fmin(checks_[check].tolerance, std::abs(other.error()) * (1 + kAsGood));
        }
      }
    }
    return std::move(checks_);
  }

 private:
  static bool is_same_run(const Check& a, const Check& b) {
    return a.quantity == b.quantity && a.poisson == b.poisson && a.grid == b.grid && a.expected == b.expected;
  }

  Check& add_check(const std::string& quantity, const Variant& variant, const std::optional<Recording>& recording) {
    const Eigen::Vector3i counts = grid_counts(scene_, variant);
    Check& check = checks_.emplace_back();
    check.experiment = name_;
    check.quantity = quantity;
    check.model = model_name(variant.model);
    check.poisson = variant.poisson;
    check.grid = fmt::format("{}x{}x{}", counts.x(), counts.y(), counts.z());
    check.bricks_across = counts.minCoeff();
    check.measured = kNone;
    check.expected = kNone;
    check.tolerance = kNone;
    if (!recording) return check;
    const Quantity measured = measure(*recording, quantity);
    check.measured = measured.value;
    check.unit = measured.unit;
    return check;
  }

  void add(const Expectation& expectation, const Variant& variant, const std::optional<Recording>& recording,
           const std::string& trouble) {
    Check& check = add_check(expectation.quantity, variant, recording);
    check.expected = expectation.value;
    check.source = expectation.source;
    if (!trouble.empty()) check.source += "; not measured: " + trouble;
    for (const Gate& gate : expectation.gates) {
      if (!applies(gate, variant)) continue;
      if (gate.tolerance) check.tolerance = std::fmin(check.tolerance, *gate.tolerance);
      if (gate.no_worse_than) rivals_.emplace_back(checks_.size() - 1, *gate.no_worse_than);
    }
  }

  /// What nothing is known to compare with at the ratio or on the grid that a person chose.
  void add_unexpected(const Variant& variant, const std::optional<Recording>& recording, const std::string& trouble) {
    std::vector<std::string> seen;
    for (const Expectation& expectation : scene_.expectations) {
      if (applies(expectation, variant)) seen.push_back(expectation.quantity);
    }
    for (const Expectation& expectation : scene_.expectations) {
      if (std::find(seen.begin(), seen.end(), expectation.quantity) != seen.end()) continue;
      seen.push_back(expectation.quantity);
      add_check(expectation.quantity, variant, recording).source =
          trouble.empty() ? "nothing known to compare with" : trouble;
    }
  }

  const std::string& name_;
  const Scene& scene_;
  bool is_chosen_;
  const Console& console_;
  Console silent_;
  std::vector<Check> checks_;
  std::vector<std::pair<std::size_t, Model>> rivals_;  // checks whose tolerance is another model's error
};

}  // namespace

std::vector<Check> run_experiment(const std::string& name, const Scene& scene, const Choice& choice,
                                  const Console& console) {
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
