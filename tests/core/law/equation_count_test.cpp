#include "core/law/equation_count.h"

#include <gtest/gtest.h>

#include <map>

#include "core/law/brick_law.h"
#include "core/law/rectangle_law.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

std::map<std::string, EquationCount> table() {
  std::map<std::string, EquationCount> rows;
  for (const EquationCount& row : count_equations(table_configurations())) rows[row.name] = row;
  return rows;
}

SpringConfiguration configuration(const std::string& name) {
  for (const SpringConfiguration& known : table_configurations()) {
    if (known.name == name) return known;
  }
  ADD_FAILURE() << "no configuration " << name;
  return {};
}

void expect_counts(const EquationCount& row, int unknowns, int young, int poisson, int shear, int rank) {
  EXPECT_EQ(row.unknowns, unknowns) << row.name;
  EXPECT_EQ(row.young_equations, young) << row.name;
  EXPECT_EQ(row.poisson_equations, poisson) << row.name;
  EXPECT_EQ(row.shear_equations, shear) << row.name;
  EXPECT_EQ(row.equations, young + poisson + shear) << row.name;
  EXPECT_EQ(row.rank, rank) << row.name;
}

/// The counts by hand: one Young equation an axis, one Poisson equation for each axis across it, one shear equation a
/// plane; equal sides make them one each.
TEST(EquationCount, CountsUnknownsAndEquations) {
  auto rows = table();
  EXPECT_EQ(rows.size(), 16U);
  expect_counts(rows["2D square"], 2, 1, 1, 1, 2);
  expect_counts(rows["M1 cube"], 2, 1, 1, 1, 2);
  expect_counts(rows["M2 cube"], 2, 1, 1, 1, 2);
  expect_counts(rows["M3 cube"], 3, 1, 1, 1, 2);
  expect_counts(rows["2D rectangle"], 3, 2, 2, 1, 3);
  expect_counts(rows["M1 box"], 6, 3, 6, 3, 6);
  expect_counts(rows["M2 box"], 4, 3, 6, 3, 4);
  expect_counts(rows["M3 box"], 7, 3, 6, 3, 6);
}

TEST(EquationCount, TwoEqualSidesLieBetweenBoxAndCube) {
  const std::vector<SpringConfiguration> square_bar{{"M1 square bar", 3, {2, 1, 1}, {1, 2}, false}};
  expect_counts(count_equations(square_bar).front(), 4, 2, 3, 2, 4);
}

TEST(EquationCount, PlainSpringsFitOneRatioAtMost) {
  auto rows = table();
  for (const char* name : {"2D square", "2D rectangle"}) {
    EXPECT_FALSE(rows[name].solvable) << name;
    ASSERT_TRUE(rows[name].poisson.has_value()) << name;
    EXPECT_NEAR(*rows[name].poisson, 1.0 / 3, 1e-12) << name;
  }
  for (const char* name : {"M1 cube", "M2 cube", "M3 cube", "M1 box", "M3 box"}) {
    EXPECT_FALSE(rows[name].solvable) << name;
    ASSERT_TRUE(rows[name].poisson.has_value()) << name;
    EXPECT_NEAR(*rows[name].poisson, 0.25, 1e-12) << name;
  }
  // One inner diagonal cannot serve the three planes of a box: their shears meet it in different proportions.
  EXPECT_FALSE(rows["M2 box"].solvable);
  EXPECT_FALSE(rows["M2 box"].poisson.has_value());
}

TEST(EquationCount, CorrectionsFitEveryRatio) {
  for (const auto& [name, row] : table()) {
    if (name.find("corrected") == std::string::npos) continue;
    EXPECT_EQ(row.solvable, name.find("M2 box") == std::string::npos) << name;
    EXPECT_FALSE(row.poisson.has_value()) << name;
  }
}

/// The residual of the equations of one kind for the stiffnesses of a law, Pa, for E = 1 Pa.
double misfit(const SpringEquations& equations, const Eigen::VectorXd& stiffnesses, EquationKind kind) {
  const Eigen::VectorXd left = equations.matrix * stiffnesses - equations.right;
  double worst = 0;
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    if (equations.kinds[i] == kind) worst = std::max(worst, std::abs(left[i]));
  }
  return worst;
}

void expect_only_poisson_fails(const SpringEquations& equations, const Eigen::VectorXd& stiffnesses, bool fails) {
  EXPECT_LT(misfit(equations, stiffnesses, EquationKind::kYoung), 1e-12);
  EXPECT_LT(misfit(equations, stiffnesses, EquationKind::kShear), 1e-12);
  if (fails) {
    EXPECT_GT(misfit(equations, stiffnesses, EquationKind::kPoisson), 1e-3);
  } else {
    EXPECT_LT(misfit(equations, stiffnesses, EquationKind::kPoisson), 1e-12);
  }
}

/// The paper satisfies the Young and shear equations and leaves Poisson's to the correction. So must its stiffnesses.
TEST(EquationCount, LawsOfTheElementsAnswerTheEquations) {
  for (const double poisson : {0.1, 0.25, 1.0 / 3, 0.4}) {
    const Material unit = test::test_material(poisson, 1);
    const BrickLaw m1 = brick_law(Model::kM1Plain, unit, 1);
    const BrickLaw m2 = brick_law(Model::kM2Plain, unit, 1);
    const bool three = poisson != 0.25;
    expect_only_poisson_fails(spring_equations(configuration("M1 cube"), poisson), Eigen::Vector2d(m1.edge, m1.face),
                              three);
    expect_only_poisson_fails(spring_equations(configuration("M2 cube"), poisson), Eigen::Vector2d(m2.edge, m2.inner),
                              three);
    const SpringConfiguration rectangle = configuration("2D rectangle");
    const RectangleLaw law = rectangle_law(RectangleModel::kPlain, unit, {rectangle.sides[0], rectangle.sides[1]});
    expect_only_poisson_fails(spring_equations(rectangle, poisson),
                              Eigen::Vector3d(law.edge[0], law.edge[1], law.diagonal), poisson != 1.0 / 3);
  }
}

}  // namespace
}  // namespace sprung
