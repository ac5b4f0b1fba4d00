#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "app/validate/cases.h"
#include "app/validate/responses.h"
#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "core/law/equation_count.h"

namespace sprung {
namespace {

constexpr double kExact = 1e-9;
constexpr double kSide = 0.1;          // of a brick of the patch, m
constexpr double kYoung = 1000;        // of the patch, Pa
constexpr double kStrain = 0.01;       // of the patch
constexpr unsigned kSeed = 20090;      // of the patch's grids
constexpr double kStretchStep = 1e-4;  // for the slope at rest
constexpr double kSlopeTolerance = 1e-6;

/// A stretch along one axis (0 to 2), or a shear in one plane.
Mat3 strain_of(int which) {
  Mat3 strain = Mat3::Zero();
  const int i = which % 3;
  const int j = which < 3 ? i : (i + 1) % 3;
  strain(i, j) = strain(j, i) = kStrain;
  return strain;
}

/// A box of bricks in equilibrium, its outer nodes displaced by a uniform strain.
struct Patch {
  Body body;
  LinearResponse response;
  Points uniform;  // displacements, m
};

Patch strained_patch(const Eigen::Vector3i& counts, Model model, double poisson, const Mat3& strain) {
  Patch patch{.body = make_body(make_box_grid(counts, kSide), model, light_material(kYoung, poisson)),
              .response = {},
              .uniform = {}};
  Body& body = patch.body;
  patch.uniform = body.rest_positions * strain;
  Supports supports(body.node_count());
  for (int node = 0; node < body.node_count(); ++node) {
    const Eigen::Array3i place = body.grid.lattice[node].array();
    const bool is_inside = (place > 0).all() && (place < counts.array()).all();
    if (!is_inside) supports.fix(node);
  }
  const auto system = make_direct_solver();
  patch.response = linear_response(body, supports, Points::Zero(body.node_count(), 3), patch.uniform, *system);
  body.positions += patch.response.displacements;
  return patch;
}

/// The worst of the six strains: errors of the inner displacements and of the mean stress, and the energy.
void measure_patch(const Eigen::Vector3i& counts, Model model, double poisson, Check& inner, Check& stress,
                   Check& energy) {
  const Material material = light_material(kYoung, poisson);
  inner.measured = stress.measured = 0;
  for (int which = 0; which < 6; ++which) {
    const Mat3 strain = strain_of(which);
    const Patch patch = strained_patch(counts, model, poisson, strain);
    const Points& forces = patch.response.reactions;
    const Points& moved = patch.response.displacements;
    const double volume = patch.body.grid.volume();
    const Mat3 expected =
        material.lame_lambda() * strain.trace() * Mat3::Identity() + 2 * material.shear_modulus() * strain;
    const Mat3 mean = forces.transpose() * patch.body.rest_positions / volume;
    inner.measured =
        std::max(inner.measured, (moved - patch.uniform).cwiseAbs().maxCoeff() / moved.cwiseAbs().maxCoeff());
    stress.measured = std::max(stress.measured, (mean - expected).norm() / expected.norm());
    const double stored = 0.5 * forces.cwiseProduct(moved).sum();
    const double expected_energy = 0.5 * volume * expected.cwiseProduct(strain).sum();
    if (which > 0 && std::abs(stored / expected_energy - 1) < std::abs(energy.error())) continue;
    energy.measured = stored;
    energy.expected = expected_energy;
  }
}

/// Adds three checks. Plain springs have a tolerance for stress and energy at nu = 1/4 only.
void add_patch_checks(Model model, double poisson, const Eigen::Vector3i& counts, std::vector<Check>& checks) {
  constexpr std::string_view kSource = "isotropic elasticity, stress = lambda tr(strain) I + 2 G strain";
  Check inner{.experiment = "patch",
              .quantity = "inner.displacement",
              .model = std::string(model_name(model)),
              .poisson = poisson,
              .grid = fmt::format("{}x{}x{}", counts.x(), counts.y(), counts.z()),
              .bricks_across = double(counts.minCoeff())};
  Check stress = inner;
  Check energy = inner;
  inner.source = "a uniform strain, error over the largest displacement";
  stress.quantity = "mean.stress.error";
  stress.source = kSource;
  energy.quantity = "energy";
  energy.unit = 'J';
  energy.source = fmt::format("{}; energy = stress : strain / 2 x volume", kSource);
  try {
    measure_patch(counts, model, poisson, inner, stress, energy);
    const bool is_plain = model == Model::kM1Plain || model == Model::kM2Plain;
    inner.tolerance = kExact;
    if (!is_plain || poisson == 0.25) stress.tolerance = energy.tolerance = kExact;
  } catch (const Error& error) {
    for (Check* check : {&inner, &stress, &energy}) {
      check->measured = kNaN;
      check->trouble = error.what();
    }
    energy.expected = kNaN;
  }
  for (const Check& check : {inner, stress, energy}) checks.push_back(check);
}

}  // namespace

CaseResult run_patch(const Choice& choice) {
  std::mt19937 random(kSeed);
  std::vector<Model> models;
  for (const std::string_view name : model_names()) models.push_back(model_from_name(name));
  if (choice.model) models = {*choice.model};
  std::vector<double> ratios{-0.2, 0, 0.1, 0.25, 0.3, 0.4, 0.49};
  if (choice.poisson) ratios = {*choice.poisson};
  CaseResult result;
  for (const double poisson : ratios) {
    Eigen::Vector3i counts(3, 2, 2);
    if (poisson != ratios.front()) {
      for (int& count : counts) count = 2 + int(random() % 3);
    }
    if (choice.bricks) counts = {*choice.bricks, 2, 2};
    for (const Model model : models) add_patch_checks(model, poisson, counts, result.checks);
  }
  return result;
}

CasePicture draw_patch() {
  constexpr double kMagnification = 20;
  const Patch patch = strained_patch({3, 2, 2}, Model::kCalibrated, 0.3, strain_of(3));
  return {draw_body(patch.body, {.magnification = kMagnification}),
          fmt::format("3×2×2 bricks in shear, ν = 0.3, displacements magnified {:g} times", kMagnification)};
}

CaseResult run_equations(const Choice& choice) {
  CaseResult result;
  if (choice.is_any()) return result;
  const std::vector<SpringConfiguration> configurations = table_configurations();
  const std::vector<EquationCount> counts = count_equations(configurations);
  result.table.head = {"element", "unknowns", "equations", "for E", "for nu", "for G", "rank", "solved for nu"};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const EquationCount& count = counts[i];
    std::vector<std::string>& row = result.table.rows.emplace_back();
    row.push_back(count.name);
    for (const int number : {count.unknowns, count.equations, count.young_equations, count.poisson_equations,
                             count.shear_equations, count.rank}) {
      row.push_back(fmt::format("{}", number));
    }
    row.push_back(count.solvable ? "any" : count.poisson ? fmt::format("{:.6g} only", *count.poisson) : "none");
    if (!count.poisson) continue;
    const bool is_flat = configurations[i].dimensions == 2;
    const double expected = is_flat ? 1.0 / 3 : 0.25;
    result.checks.push_back({.experiment = "equations",
                             .quantity = "solvable.poisson",
                             .model = count.name,
                             .poisson = std::round(1e4 * expected) / 1e4,
                             .measured = *count.poisson,
                             .expected = expected,
                             .source = is_flat ? "Cauchy: central forces make lambda = G, 1/3 in plane stress"
                                               : "Cauchy: central forces make lambda = G, 1/4 in space",
                             .tolerance = kExact});
  }
  return result;
}

CaseResult run_uniaxial(const Choice& choice) {
  const Material material = light_material(1, choice.poisson.value_or(0.3));
  constexpr std::array<Model, 3> kModels{Model::kCalibrated, Model::kTensile, Model::kM1};
  std::vector<UniaxialLaw> laws;  // those that can be evaluated
  CaseResult result;
  for (const UniaxialLaw& law : uniaxial_laws(kModels, material)) {
    if (choice.model && law.model && law.model != choice.model) continue;
    Check check{.experiment = "uniaxial",
                .quantity = "slope.at.rest",
                .model = law.name,
                .poisson = material.poisson,
                .grid = "1x1x1",
                .bricks_across = 1,
                .expected = material.young,
                .unit = "Pa",
                .source = "Young's modulus, by central differences"};
    try {
      check.measured =
          (law.response(1 + kStretchStep).stress - law.response(1 - kStretchStep).stress) / (2 * kStretchStep);
      check.tolerance = kSlopeTolerance;
      laws.push_back(law);
    } catch (const Error& error) {
      check.trouble = error.what();
    }
    result.checks.push_back(check);
  }
  result.table.head = {"stress / E at stretch"};
  for (const UniaxialLaw& law : laws) result.table.head.push_back(law.name);
  for (const double stretch : {0.5, 0.6, 0.75, 0.9, 1.1, 1.25, 1.5, 1.75, 2.0}) {
    std::vector<std::string>& row = result.table.rows.emplace_back();
    row.push_back(fmt::format("{:g}", stretch));
    for (const UniaxialLaw& law : laws) row.push_back(fmt::format("{:.4f}", law.response(stretch).stress));
  }
  return result;
}

}  // namespace sprung
