#include "core/law/solid/uniaxial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/bodies.h"

namespace sprung {
namespace {

TEST(UniaxialState, LeavesTheSidesFree) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    for (const double poisson : {-0.2, 0.0, 0.3, 0.49, 0.4999}) {
      const Material material = test::material_of_law(law, poisson);
      const StrainEnergy psi(material);
      for (const double stretch : {0.2, 0.5, 0.9, 1.1, 1.3, 2.0, 4.0}) {
        const UniaxialState state = uniaxial_state(psi, stretch);
        if (std::isnan(state.sideways)) continue;
        const Mat3 gradient = Vec3(stretch, state.sideways, state.sideways).asDiagonal();
        const Mat3 stress = psi.stress(gradient);
        // As near to zero as rounding of the sideways stretch lets it come.
        const double limit = 1e-14 * psi.hessian(gradient).norm();
        EXPECT_LT(std::abs(stress(1, 1)), limit) << law_text(law) << ' ' << poisson << ' ' << stretch;
        EXPECT_NEAR(stress(0, 0), state.stress, limit) << law_text(law) << ' ' << poisson << ' ' << stretch;
      }
    }
  }
}

/// E s (s^2 - 1) / 2, and t^2 = 1 - nu (s^2 - 1) until the sides vanish.
TEST(UniaxialState, OfTheLinearLawEndsWhereItsSidesVanish) {
  const Material material = test::material_of_law({.kind = StrainEnergyKind::kLinear}, 0.4);
  const double last = std::sqrt(1 + 1 / 0.4);
  for (const double stretch : {0.7, 1.2, 1.8, 0.999999 * last}) {
    const UniaxialState state = uniaxial_state(StrainEnergy(material), stretch);
    EXPECT_NEAR(state.stress, material.young * stretch * (stretch * stretch - 1) / 2, 1e-9 * material.young);
    EXPECT_NEAR(state.sideways * state.sideways, 1 - 0.4 * (stretch * stretch - 1), 1e-9);
  }
  EXPECT_TRUE(std::isnan(uniaxial_state(StrainEnergy(material), 1.000001 * last).sideways));
}

TEST(UniaxialState, IsAtRestUnlessStretched) {
  const UniaxialState found = uniaxial_state(StrainEnergy(test::test_material(0.3)), 1);
  EXPECT_EQ(found.sideways, UniaxialState{}.sideways);
  EXPECT_EQ(found.stress, UniaxialState{}.stress);
}

}  // namespace
}  // namespace sprung
