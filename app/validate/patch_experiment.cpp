#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "app/validate/built_in_cases.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kExact = 1e-9;
constexpr double kSide = 0.1;      // of a brick, m
constexpr double kYoung = 1000;    // Pa
constexpr double kStrain = 0.01;   // of each experiment
constexpr unsigned kSeed = 20090;  // of the grids
constexpr std::array<double, 7> kRatios{-0.2, 0, 0.1, 0.25, 0.3, 0.4, 0.49};
constexpr std::string_view kSource = "isotropic elasticity, stress = lambda tr(strain) I + 2 G strain";

/// A stretch along one axis (0 to 2), or a shear in one plane.
Mat3 strain_of(int which) {
  Mat3 strain = Mat3::Zero();
  const int i = which % 3;
  const int j = which < 3 ? i : (i + 1) % 3;
  strain(i, j) = strain(j, i) = kStrain;
  return strain;
}

Mat3 stress_of(const Material& material, const Mat3& strain) {
  return material.lame_lambda() * strain.trace() * Mat3::Identity() + 2 * material.shear_modulus() * strain;
}

bool is_inside(const Eigen::Vector3i& node, const Eigen::Vector3i& counts) {
  return (node.array() > 0).all() && (node.array() < counts.array()).all();
}

/// A box whose outer nodes are held in a uniform strain, and whose inner nodes found their own place.
struct Patch {
  Body body;
  LinearResponse response;
  Points uniform;  // displacements, m
};

Patch strained(const Eigen::Vector3i& counts, Model model, const Material& material, const Mat3& strain) {
  Patch patch{.body = make_body(make_box_grid(counts, kSide), model, material), .response = {}, .uniform = {}};
  Body& body = patch.body;
  patch.uniform = body.rest_positions * strain;
  Supports supports(body.node_count());
  for (int node = 0; node < body.node_count(); ++node) {
    if (!is_inside(body.grid.lattice[node], counts)) supports.fix(node);
  }
  const auto system = make_direct_solver();
  const Points no_loads = Points::Zero(body.node_count(), 3);
  patch.response = linear_response(body, supports, no_loads, patch.uniform, *system);
  body.positions += patch.response.displacements;
  return patch;
}

/// The worst over the six strains.
struct PatchErrors {
  double inner = 0;   // way of an inner node from its place in the uniform strain, over the largest displacement
  double stress = 0;  // norm of the mean stress that the outer nodes report, against elasticity's
  double energy = 0;  // J, the one that is farthest off
  double expected_energy = 0;
};

void include(const Patch& patch, const Mat3& strain, const Material& material, PatchErrors& worst) {
  const Points& held = patch.response.reactions;
  const Points& moved = patch.response.displacements;
  const double volume = patch.body.grid.volume();
  const Mat3 expected = stress_of(material, strain);
  const Mat3 stress = held.transpose() * patch.body.rest_positions / volume;
  worst.inner = std::max(worst.inner, (moved - patch.uniform).cwiseAbs().maxCoeff() / moved.cwiseAbs().maxCoeff());
  worst.stress = std::max(worst.stress, (stress - expected).norm() / expected.norm());
  const double energy = 0.5 * held.cwiseProduct(moved).sum();
  const double expected_energy = 0.5 * volume * expected.cwiseProduct(strain).sum();
  const bool is_first = worst.expected_energy == 0;
  if (!is_first && std::abs(energy / expected_energy - 1) < std::abs(worst.energy / worst.expected_energy - 1)) return;
  worst.energy = energy;
  worst.expected_energy = expected_energy;
}

Material material_of(double poisson) {
  return {.name = "patch", .young = kYoung, .poisson = poisson, .density = 1, .damping = 0, .source = ""};
}

Check check_of(std::string_view quantity, Model model, double poisson, const Eigen::Vector3i& counts) {
  Check check;
  check.experiment = "patch";
  check.quantity = quantity;
  check.model = model_name(model);
  check.poisson = poisson;
  check.grid = fmt::format("{}x{}x{}", counts.x(), counts.y(), counts.z());
  check.bricks_across = counts.minCoeff();
  check.measured = kNone;
  return check;
}

bool is_plain(Model model) { return model == Model::kM1Plain || model == Model::kM2Plain; }

/// Three checks of one model; springs alone are held to the strain's shape only, but at nu = 1/4 to all.
void add_checks(Model model, double poisson, const Eigen::Vector3i& counts, std::vector<Check>& checks) {
  const Material material = material_of(poisson);
  PatchErrors worst;
  std::string trouble;
  try {
    for (int which = 0; which < 6; ++which) {
      include(strained(counts, model, material, strain_of(which)), strain_of(which), material, worst);
    }
  } catch (const Error& error) {
    trouble = error.what();
    worst = {.inner = kNone, .stress = kNone, .energy = kNone, .expected_energy = kNone};
  }
  const bool is_answered = trouble.empty() && (!is_plain(model) || poisson == 0.25);
  Check inner = check_of("inner.displacement", model, poisson, counts);
  inner.measured = worst.inner;
  inner.tolerance = trouble.empty() ? kExact : kNone;
  inner.source = "a uniform strain, error over the largest displacement";
  Check stress = check_of("mean.stress.error", model, poisson, counts);
  stress.measured = worst.stress;
  stress.tolerance = is_answered ? kExact : kNone;
  stress.source = kSource;
  Check energy = check_of("energy", model, poisson, counts);
  energy.measured = worst.energy;
  energy.expected = worst.expected_energy;
  energy.unit = 'J';
  energy.tolerance = is_answered ? kExact : kNone;
  energy.source = fmt::format("{}; energy = stress : strain / 2 x volume", kSource);
  for (Check* check : {&inner, &stress, &energy}) {
    check->trouble = trouble;
    checks.push_back(*check);
  }
}

}  // namespace

CaseResult run_patch(const Choice& choice) {
  std::mt19937 random(kSeed);
  std::vector<Model> models;
  for (const std::string_view name : model_names()) models.push_back(model_from_name(name));
  if (choice.model) models = {*choice.model};
  std::vector<double> ratios(kRatios.begin(), kRatios.end());
  if (choice.poisson) ratios = {*choice.poisson};
  CaseResult result;
  for (const double poisson : ratios) {
    Eigen::Vector3i counts(3, 2, 2);
    if (poisson != ratios.front()) {
      for (int& count : counts) count = 2 + int(random() % 3);
    }
    if (choice.bricks) counts = {*choice.bricks, 2, 2};
    for (const Model model : models) add_checks(model, poisson, counts, result.checks);
  }
  return result;
}

ReportPicture draw_patch() {
  constexpr double kMagnification = 20;
  const Patch patch = strained({3, 2, 2}, Model::kCalibrated, material_of(0.3), strain_of(3));
  ExperimentPicture drawn = draw_experiment(patch.body, {.magnification = kMagnification});
  return {.experiment = "",
          .caption = fmt::format("3×2×2 bricks in shear, displacements drawn {:g} times as large", kMagnification),
          .image = std::move(drawn.image),
          .colors = std::move(drawn.colors)};
}

}  // namespace sprung
