#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "app/report/uniaxial.h"
#include "app/validate/built_in_cases.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr double kStep = 1e-4;  // of the stretch, for the slope at rest
constexpr double kTolerance = 1e-6;
constexpr std::array<double, 9> kStretches{0.5, 0.6, 0.75, 0.9, 1.1, 1.25, 1.5, 1.75, 2};

struct Law {
  std::string name;
  std::function<UniaxialResponse(double)> at;  // of the stretch
};

/// Laws with E = 1 Pa: those of the bricks that were asked for, and the two textbooks'.
std::vector<Law> laws_of(const Choice& choice, const Material& material) {
  std::vector<Law> laws;
  for (const Model model : {Model::kCalibrated, Model::kTensile, Model::kM1}) {
    if (choice.model && *choice.model != model) continue;
    laws.push_back(
        {std::string(model_name(model)), [=](double stretch) { return brick_uniaxial(model, material, stretch); }});
  }
  laws.push_back({"neo-Hookean", [=](double stretch) { return neo_hookean_uniaxial(material, stretch); }});
  laws.push_back(
      {"St. Venant-Kirchhoff", [=](double stretch) { return st_venant_kirchhoff_uniaxial(material, stretch); }});
  return laws;
}

Check slope_check(const Law& law, const Material& material) {
  Check check;
  check.experiment = "uniaxial";
  check.quantity = "slope.at.rest";
  check.model = law.name;
  check.poisson = material.poisson;
  check.grid = "1x1x1";
  check.bricks_across = 1;
  check.expected = material.young;
  check.unit = "Pa";
  check.source = "Young's modulus, by central differences";
  check.tolerance = kTolerance;
  try {
    check.measured = (law.at(1 + kStep).stress - law.at(1 - kStep).stress) / (2 * kStep);
  } catch (const Error& error) {
    check.trouble = error.what();
    check.measured = check.tolerance = std::numeric_limits<double>::quiet_NaN();
  }
  return check;
}

}  // namespace

CaseResult run_uniaxial(const Choice& choice) {
  const Material material{
      .name = "unit", .young = 1, .poisson = choice.poisson.value_or(0.3), .density = 1, .damping = 0, .source = ""};
  CaseResult result;
  std::vector<Law> laws = laws_of(choice, material);
  for (const Law& law : laws) result.checks.push_back(slope_check(law, material));
  std::erase_if(laws, [&](const Law& law) {
    return std::any_of(result.checks.begin(), result.checks.end(),
                       [&](const Check& check) { return check.model == law.name && !check.trouble.empty(); });
  });
  result.table.head = {"stress / E at stretch"};
  for (const Law& law : laws) result.table.head.push_back(law.name);
  for (const double stretch : kStretches) {
    std::vector<std::string>& row = result.table.rows.emplace_back();
    row.push_back(fmt::format("{:g}", stretch));
    for (const Law& law : laws) row.push_back(fmt::format("{:.4f}", law.at(stretch).stress));
  }
  return result;
}

}  // namespace sprung
