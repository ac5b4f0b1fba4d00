#include "app/validate/responses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bodies.h"

namespace sprung {
namespace {

/// Every law responds to small strains with E and nu.
TEST(Uniaxial, SlopeAtRestIsYoungsModulus) {
  constexpr double kStep = 1e-4;
  for (const double poisson : {-0.2, 0.0, 0.25, 0.3, 0.45, 0.49}) {
    const Material material = test::test_material(poisson, 2e4);
    const auto expect_elastic = [&](const auto& law) {
      const UniaxialResponse more = law(1 + kStep);
      const UniaxialResponse less = law(1 - kStep);
      EXPECT_NEAR((more.stress - less.stress) / (2 * kStep) / material.young, 1, 1e-6) << poisson;
      EXPECT_NEAR((more.sideways - less.sideways) / (2 * kStep), -poisson, 1e-6) << poisson;
    };
    for (const Model model : {Model::kCalibrated, Model::kTensile}) {
      expect_elastic([&](double stretch) { return brick_uniaxial(model, material, stretch); });
    }
    expect_elastic([&](double stretch) { return st_venant_kirchhoff_uniaxial(material, stretch); });
    expect_elastic([&](double stretch) { return neo_hookean_uniaxial(material, stretch); });
  }
}

/// At nu = 0 nothing moves sideways in St. Venant-Kirchhoff: stress = E s (s^2 - 1) / 2.
TEST(Uniaxial, AgreesWithClosedForms) {
  const UniaxialResponse venant = st_venant_kirchhoff_uniaxial(test::test_material(0, 1), 2);
  EXPECT_DOUBLE_EQ(venant.sideways, 1);
  EXPECT_DOUBLE_EQ(venant.stress, 3);
  // Nearly incompressible: t = 1/sqrt(s), stress = G (s - 1/s^2).
  const Material rubber = test::test_material(0.499999, 3);
  const UniaxialResponse neo = neo_hookean_uniaxial(rubber, 2);
  EXPECT_NEAR(neo.sideways, std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(neo.stress, rubber.shear_modulus() * (2 - 0.25), 1e-4);
}

TEST(Uniaxial, FindsTheSidewaysStretchOverTheWholePlot) {
  for (const Model model : test::kCorrectedModels) {
    for (int i = 0; i <= 30; ++i) {
      const double stretch = 0.5 + 0.05 * i;
      EXPECT_TRUE(std::isfinite(brick_uniaxial(model, test::test_material(0.3), stretch).stress)) << stretch;
    }
  }
}

TEST(Locking, StopsTheHexahedronAndNotTheBrick) {
  const auto references = reference_deflections();
  const DeflectionAt& near_half = references.back();
  ASSERT_DOUBLE_EQ(near_half.poisson, 0.49);
  EXPECT_NEAR(cantilever_deflection(Model::kCalibrated, 0.49, 4) / near_half.deflection, 1, 0.04);
  EXPECT_LT(cantilever_deflection(Model::kFem, 0.49, 4) / near_half.deflection, 0.75);
}

}  // namespace
}  // namespace sprung
