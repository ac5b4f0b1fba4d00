#include "app/validate/cases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sprung {
namespace {

/// The checks that are gates of a case; expects that they pass.
std::vector<const Check*> held_gates(const CaseResult& result) {
  std::vector<const Check*> gates;
  for (const Check& check : result.checks) {
    if (!check.is_gate()) continue;
    EXPECT_TRUE(check.passed()) << check.quantity << ' ' << check.model << " nu " << check.poisson;
    gates.push_back(&check);
  }
  return gates;
}

/// Every model with corrections at every ratio it can have, and the plain ones at the one ratio they can represent.
TEST(Patch, IsExactWhereItHasToBe) {
  const CaseResult result = run_patch({});
  const std::vector<const Check*> gates = held_gates(result);
  const auto energies = [&](const std::string& model) {
    return std::count_if(gates.begin(), gates.end(),
                         [&](const Check* gate) { return gate->quantity == "energy" && gate->model == model; });
  };
  EXPECT_EQ(energies("calibrated"), 7);
  EXPECT_EQ(energies("tensile"), 7);
  EXPECT_EQ(energies("m1"), 6);  // not at -0.2
  EXPECT_EQ(energies("m1-plain"), 1);
  EXPECT_EQ(energies("m2-plain"), 1);
  const auto off = std::find_if(result.checks.begin(), result.checks.end(), [](const Check& check) {
    return check.quantity == "energy" && check.model == "m2-plain" && check.poisson == 0.4;
  });
  ASSERT_NE(off, result.checks.end());
  EXPECT_GT(std::abs(off->error()), 0.01);
}

TEST(Patch, AnswersToAChoice) {
  const CaseResult result = run_patch({.model = Model::kTensile, .poisson = 0.17, .bricks = 4});
  ASSERT_EQ(held_gates(result).size(), 3U);
  EXPECT_EQ(result.checks[0].model, "tensile");
  EXPECT_EQ(result.checks[0].poisson, 0.17);
  EXPECT_EQ(result.checks[0].grid, "4x2x2");
}

TEST(Membranes, HoldTheirGates) {
  for (const auto run : {run_membrane_patch, run_membrane_stretch, run_membrane_shear, run_membrane_cantilever}) {
    EXPECT_GE(held_gates(run({})).size(), 4U);
  }
}

TEST(Membranes, AnswerToAChoice) {
  for (const auto run : {run_membrane_stretch, run_membrane_shear, run_membrane_cantilever}) {
    const CaseResult result = run({.model = Model::kTensile, .poisson = 0.17, .bricks = 12});
    ASSERT_EQ(result.checks.size(), 1U);
    EXPECT_EQ(result.checks[0].model, "2d-corrected");
    EXPECT_EQ(result.checks[0].poisson, 0.17);
    EXPECT_EQ(result.checks[0].grid, "12x3");
    EXPECT_TRUE(run({.model = Model::kFem, .poisson = {}, .bricks = {}}).checks.empty());
  }
}

TEST(Membranes, SayWhereThereAreNoSprings) {
  const CaseResult result = run_membrane_stretch({.model = Model::kM1Plain, .poisson = -0.9, .bricks = 5});
  ASSERT_EQ(result.checks.size(), 1U);
  EXPECT_NE(result.checks[0].trouble, "");
  EXPECT_FALSE(result.checks[0].is_gate());
}

TEST(Equations, AreATableAndTheRatiosOfPlainSprings) {
  const CaseResult result = run_equations({});
  EXPECT_EQ(result.table.rows.size(), 16U);
  for (const auto& row : result.table.rows) EXPECT_EQ(row.size(), result.table.head.size());
  EXPECT_EQ(held_gates(result).size(), 7U);
  EXPECT_TRUE(run_equations({.model = Model::kM1, .poisson = {}, .bricks = {}}).checks.empty());
}

TEST(UniaxialCase, HoldsItsGatesAndKeepsToTheChoice) {
  const CaseResult result = run_uniaxial({});
  EXPECT_EQ(held_gates(result).size(), 5U);
  EXPECT_EQ(result.table.head.size(), 6U);
  EXPECT_EQ(run_uniaxial({.model = Model::kM1, .poisson = -0.1, .bricks = {}}).table.head.size(), 3U);
}

/// Published numbers, each measured; they exclude a choice of grid.
TEST(Tables, HoldTheirGates) {
  const CaseResult result = run_tables({}, Observer());
  for (const Check& check : result.checks) EXPECT_EQ(check.trouble, "") << check.quantity;
  EXPECT_GE(held_gates(result).size(), 26U);
  EXPECT_TRUE(run_tables({.model = {}, .poisson = {}, .bricks = 4}, Observer()).checks.empty());
}

TEST(Cut, HoldsItsGates) {
  const CaseResult result = run_cut({.model = Model::kCalibrated, .poisson = {}, .bricks = {}}, Observer());
  for (const Check& check : result.checks) EXPECT_EQ(check.trouble, "") << check.quantity;
  EXPECT_GE(held_gates(result).size(), 50U);
  EXPECT_TRUE(run_cut({.model = {}, .poisson = {}, .bricks = 4}, Observer()).checks.empty());
}

}  // namespace
}  // namespace sprung
