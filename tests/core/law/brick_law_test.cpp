#include "core/law/brick_law.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "tests/support/bodies.h"
#include "tests/support/error_message.h"

namespace sprung {
namespace {

using test::corner_displacements;
using test::kCorrectedModels;
using test::kPoissonRatios;
using test::rest_brick;
using test::rest_stiffness;
using test::test_material;

constexpr double kSide = 0.05;

/// Stress of isotropic elasticity, Pa.
Mat3 stress(const Material& material, const Mat3& strain) {
  return material.lame_lambda() * strain.trace() * Mat3::Identity() + 2 * material.shear_modulus() * strain;
}

/// A unit strain in one entry of Voigt's list: 3 stretches, then 3 shears.
Mat3 unit_strain(int which) {
  Mat3 strain = Mat3::Zero();
  if (which < 3) {
    strain(which, which) = 1;
  } else {
    const int i = which - 3;
    const int j = (i + 1) % 3;
    strain(i, j) = strain(j, i) = 0.5;
  }
  return strain;
}

/// The force that each face exerts: the sum over its four corners, one column for each of +x, +y, +z.
Mat3 face_forces(const Eigen::Matrix<double, 24, 1>& force) {
  Mat3 sums = Mat3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      if (on_high_side(corner, axis)) sums.col(axis) += force.segment<3>(3 * corner);
    }
  }
  return sums;
}

/// A sheared brick with inner diagonals also presses its corners in a pattern that sums to nothing on every face and
/// that its neighbours cancel, so forces are compared face by face.
TEST(BrickLaw, UniformStrainAnswersLikeIsotropicElasticity) {
  for (const Model model : {Model::kTensile, Model::kM1}) {
    for (const double poisson : kPoissonRatios) {
      if (model == Model::kM1 && poisson < 0) continue;  // M1 has no springs for it
      const Material material = test_material(poisson);
      const BrickMatrix stiffness = rest_stiffness(model, material, kSide);
      for (int which = 0; which < 6; ++which) {
        const Mat3 strain = unit_strain(which);
        const auto u = corner_displacements(kSide, [&](const Vec3& p) -> Vec3 { return strain * p; });
        const Eigen::Matrix<double, 24, 1> force = stiffness * u;
        const Mat3 expected_stress = stress(material, strain);
        const Mat3 expected = expected_stress * kSide * kSide;
        const double energy = (expected_stress.array() * strain.array()).sum() * kSide * kSide * kSide;
        EXPECT_LT((face_forces(force) - expected).norm(), 1e-12 * expected.norm())
            << model_name(model) << " nu " << poisson;
        EXPECT_NEAR(u.dot(force), energy, 1e-12 * energy) << model_name(model) << " nu " << poisson;
      }
    }
  }
}

TEST(BrickLaw, TensileNeedsNoCorrectionOnlyAtOneQuarter) {
  for (const double poisson : kPoissonRatios) {
    const BrickLaw law = brick_law(Model::kTensile, test_material(poisson), kSide);
    const double scale = test_material(poisson).young * kSide;
    const bool plain = std::abs(law.axial_self) + std::abs(law.axial_cross) < 1e-12 * scale;
    EXPECT_EQ(plain, poisson == 0.25) << poisson;
  }
}

TEST(BrickLaw, TensileConstantsAreThePapers) {
  const double nu = 0.37;
  const BrickLaw law = brick_law(Model::kTensile, test_material(nu, 1e4), 0.1);
  EXPECT_NEAR(law.inner, 3 * 1e4 * 0.1 / (8 * 1.37), 1e-9);
  EXPECT_NEAR(law.edge, 1e4 * 0.1 * (4 * nu + 1) / (8 * 1.37), 1e-9);
  EXPECT_EQ(law.face, 0);
}

TEST(BrickLaw, M1ConstantsAreThePapers) {
  const double nu = 0.37;
  const double shear = 1e4 / (2 * (1 + nu));
  for (const Model model : {Model::kM1, Model::kM1Plain}) {
    const BrickLaw law = brick_law(model, test_material(nu, 1e4), 0.1);
    EXPECT_NEAR(law.face, shear * 0.1 / 2, 1e-9);
    EXPECT_NEAR(law.edge, nu * shear * 0.1, 1e-9);
    EXPECT_EQ(law.inner, 0);
  }
}

TEST(BrickLaw, PaperSpringsNeedARatioThatLetsTheirEdgesPull) {
  for (const Model model : {Model::kTensile, Model::kM2Plain}) {
    EXPECT_NO_THROW((void)brick_law(model, test_material(-0.249), kSide));
    const std::string message = error_message([&] { (void)brick_law(model, test_material(-0.251), kSide); });
    EXPECT_NE(message.find("ratio of -0.25 or more"), std::string::npos) << message;
  }
  for (const Model model : {Model::kM1, Model::kM1Plain}) {
    EXPECT_NO_THROW((void)brick_law(model, test_material(0), kSide));
    EXPECT_THROW((void)brick_law(model, test_material(-0.001), kSide), Error);
  }
}

/// As far as its strain energy grows with every dilation, see StrainEnergy.
TEST(BrickLaw, CalibratedTakesEveryRatioAtWhichItDoesNotSwell) {
  EXPECT_NO_THROW((void)brick_law(Model::kCalibrated, test_material(-0.5), kSide));
  EXPECT_THROW((void)brick_law(Model::kCalibrated, test_material(-0.501), kSide), Error);
}

/// The correction's share of each corner's force in a uniform stretch along x equals the paper's 2 F_perp, with
/// F_perp = -F (4 nu - 1) / 16 for the elongation force F on a face.
TEST(BrickLaw, CorrectionIsThePapersPerpendicularForce) {
  const double strain = 1e-3;
  for (const double poisson : kPoissonRatios) {
    const Material material = test_material(poisson);
    const BrickLaw law = brick_law(Model::kTensile, material, kSide);
    const double force = material.young * strain * kSide * kSide;
    const double perpendicular = -force * (4 * poisson - 1) / 16;
    // Uniaxial stress: e = h (strain, -nu strain, -nu strain); a mean stretch tension acts as a quarter on each edge.
    const Vec3 mean = kSide * strain * Vec3(1, -poisson, -poisson);
    const double sideways =
        (law.axial_self * mean.y() + law.axial_cross * (mean.x() + mean.z()) + law.axes * mean.sum()) / 4;
    // A tension pulls inwards, F_perp is counted outwards.
    EXPECT_NEAR(-sideways, 2 * perpendicular, 1e-12 * force) << poisson;
  }
}

/// Six rigid motions, and three twists (u_x = y z and the like) that lengthen neither edges nor inner diagonals.
TEST(BrickLaw, ZeroModesOfTheTensileBrickAreNine) {
  for (const double poisson : kPoissonRatios) {
    const Material material = test_material(poisson);
    const Eigen::SelfAdjointEigenSolver<BrickMatrix> solver(rest_stiffness(Model::kTensile, material, kSide));
    const double tiny = 1e-10 * material.young * kSide;
    EXPECT_EQ((solver.eigenvalues().array().abs() < tiny).count(), 9) << poisson;
    EXPECT_GT(solver.eigenvalues().minCoeff(), -tiny) << poisson;
  }
}

/// The response of the edge springs and their correction to a common stretch of the edges is never negative: the part
/// that would be is on the mean axes, and nothing else is.
TEST(BrickLaw, OnlyTheNegativePartOfTheAxialCorrectionIsOnTheMeanAxes) {
  for (const double poisson : {-0.2, 0.0, 0.1, 0.15, 0.16, 0.3, 0.49}) {
    const Material material = test_material(poisson);
    for (const Model model : kCorrectedModels) {
      if (model == Model::kM1 && poisson < 0) continue;
      const BrickLaw law = brick_law(model, material, kSide);
      const double on_edges = law.axial_self + 2 * law.axial_cross + 4 * law.edge;
      // 3 K h less what the diagonals give.
      const double bulk = material.young / (3 * (1 - 2 * poisson));
      const double deficit = kSide * 3 * bulk - 4 * law.inner - 8 * law.face;
      EXPECT_NEAR(3 * law.axes, std::min(deficit, 0.0), 1e-12 * material.young * kSide) << poisson;
      EXPECT_NEAR(on_edges, std::max(deficit, 0.0), 1e-12 * material.young * kSide) << poisson;
    }
  }
}

}  // namespace
}  // namespace sprung
