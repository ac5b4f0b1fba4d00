#include "core/law/rectangle_law.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "core/dynamics/statics/statics.h"
#include "core/error.h"
#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::test_material;

constexpr std::array<double, 8> kRatios{-0.2, 0, 0.1, 0.25, 0.3, 1.0 / 3, 0.4, 0.49};
constexpr std::array<std::array<double, 2>, 6> kShapes{
    {{0.05, 0.05}, {0.05, 0.045}, {0.05, 0.058}, {0.07, 0.05}, {0.05, 0.2}, {0.6, 0.1}}};

using Mat2 = Eigen::Matrix2d;

std::string where(const Material& material, const std::array<double, 2>& sides) {
  return "nu " + std::to_string(material.poisson) + ", " + std::to_string(sides[0]) + " x " + std::to_string(sides[1]);
}

/// Whether the paper's edge springs pull for that shape (or push, and there is no such law).
bool has_paper_springs(const std::array<double, 2>& sides, double poisson) {
  const double slenderness = std::max(sides[0], sides[1]) / std::min(sides[0], sides[1]);
  return slenderness * slenderness <= 3 * poisson + 2;
}

/// Plane stress, Pa.
Mat2 stress(const Material& material, const Mat2& strain) {
  const double nu = material.poisson;
  return material.young / (1 - nu * nu) * (nu * strain.trace() * Mat2::Identity() + (1 - nu) * strain);
}

/// Corner displacements of a field given at points centred on the rectangle.
template <class Field>
RectangleVector corner_displacements(const RectangleLaw& law, const Field& field) {
  const RectangleVector x = rest_corners(law);
  const Vec2 centre(law.sides[0] / 2, law.sides[1] / 2);
  RectangleVector u;
  for (int corner = 0; corner < 4; ++corner) {
    const Vec2 point = x.segment<2>(2 * corner) - centre;
    u.segment<2>(2 * corner) = field(point);
  }
  return u;
}

/// Sums over the two corners on the +x side (first column) and on the +y side.
Mat2 side_forces(const RectangleVector& force) {
  Mat2 sums;
  sums.col(0) = force.segment<2>(2) + force.segment<2>(6);
  sums.col(1) = force.segment<2>(4) + force.segment<2>(6);
  return sums;
}

/// Largest relative error of energy and side forces over the three uniform strains.
double uniform_strain_error(const RectangleLaw& law, const Material& material) {
  const RectangleMatrix stiffness = rectangle_hessian(law, rest_corners(law));
  double worst = 0;
  for (const auto& [xx, yy, xy] : {std::array{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.5}, {1.0, -0.7, 0.3}}) {
    const Mat2 strain = (Mat2() << xx, xy, xy, yy).finished();
    const RectangleVector u = corner_displacements(law, [&](const Vec2& p) -> Vec2 { return strain * p; });
    const RectangleVector force = stiffness * u;
    const Mat2 expected_stress = stress(material, strain);
    const Mat2 expected = expected_stress * Vec2(law.sides[1], law.sides[0]).asDiagonal();
    const double energy = (expected_stress.array() * strain.array()).sum() * law.sides[0] * law.sides[1];
    worst = std::max(
        {worst, (side_forces(force) - expected).norm() / expected.norm(), std::abs(u.dot(force) - energy) / energy});
  }
  return worst;
}

TEST(Rectangle, CorrectedAnswersUniformStrainLikePlaneStress) {
  for (const double poisson : kRatios) {
    const Material material = test_material(poisson);
    for (const auto& sides : kShapes) {
      EXPECT_LT(uniform_strain_error(rectangle_law(RectangleModel::kCalibrated, material, sides), material), 1e-12)
          << where(material, sides);
      if (!has_paper_springs(sides, poisson)) {
        EXPECT_THROW((void)rectangle_law(RectangleModel::kCorrected, material, sides), Error) << where(material, sides);
        EXPECT_THROW((void)rectangle_law(RectangleModel::kPlain, material, sides), Error) << where(material, sides);
        continue;
      }
      EXPECT_LT(uniform_strain_error(rectangle_law(RectangleModel::kCorrected, material, sides), material), 1e-12)
          << where(material, sides);
      const double plain = uniform_strain_error(rectangle_law(RectangleModel::kPlain, material, sides), material);
      if (poisson == 1.0 / 3) {
        EXPECT_LT(plain, 1e-12) << where(material, sides);
      } else {
        EXPECT_GT(plain, 0.01) << where(material, sides);
      }
    }
  }
}

TEST(Rectangle, PlainConstantsAreThePapers) {
  const double nu = 0.37;
  const double l = 0.11;
  const double h = 0.1;
  const RectangleLaw law = rectangle_law(RectangleModel::kPlain, test_material(nu, 1e4), {l, h});
  const double scale = 1e4 / (4 * l * h * (1 + nu));
  EXPECT_NEAR(law.diagonal, scale * (l * l + h * h), 1e-9);
  EXPECT_NEAR(law.edge[0], scale * (h * h * (3 * nu + 2) - l * l), 1e-9);
  EXPECT_NEAR(law.edge[1], scale * (l * l * (3 * nu + 2) - h * h), 1e-9);
  EXPECT_EQ(law.axial_cross, 0);
  EXPECT_EQ(law.bending[0], 0);
}

/// The correction's share of each mass's force in an elongation along i is 2 F_perp across it, F_perp = i F_i (1 - 3
/// nu) / (8 j), and nothing along it.
TEST(Rectangle, CorrectionIsThePapersPerpendicularForce) {
  for (const double poisson : kRatios) {
    const Material material = test_material(poisson);
    for (const auto& sides : kShapes) {
      if (!has_paper_springs(sides, poisson)) continue;
      const RectangleLaw law = rectangle_law(RectangleModel::kCorrected, material, sides);
      const RectangleLaw plain = rectangle_law(RectangleModel::kPlain, material, sides);
      const RectangleVector x = rest_corners(law);
      const RectangleMatrix correction = rectangle_hessian(law, x) - rectangle_hessian(plain, x);
      for (int i = 0; i < 2; ++i) {
        const int j = 1 - i;
        const RectangleVector u = corner_displacements(law, [&](const Vec2& p) {
          Vec2 moved = -poisson * p;
          moved[i] = p[i];
          return moved;
        });
        const double length = sides[i];
        const double width = sides[j];
        const double force = material.young * width;  // at a strain of 1
        const double perpendicular = length * force * (1 - 3 * poisson) / (8 * width);
        const RectangleVector felt = -correction * u;
        for (int corner = 0; corner < 4; ++corner) {
          const double outward = (corner >> j & 1) != 0 ? 1 : -1;
          EXPECT_NEAR(felt[2 * corner + j] * outward, 2 * perpendicular, 1e-12 * force) << where(material, sides);
          EXPECT_NEAR(felt[2 * corner + i], 0, 1e-12 * force) << where(material, sides);
        }
      }
    }
  }
}

/// Bending with curvature 1 / m costs E / 2 times the integral of y^2 over the rectangle.
TEST(Rectangle, CalibratedBendsLikeTheContinuum) {
  for (const double poisson : kRatios) {
    const Material material = test_material(poisson);
    for (const auto& sides : kShapes) {
      const RectangleLaw law = rectangle_law(RectangleModel::kCalibrated, material, sides);
      const RectangleMatrix stiffness = rectangle_hessian(law, rest_corners(law));
      for (int i = 0; i < 2; ++i) {
        const int j = 1 - i;
        const RectangleVector u = corner_displacements(law, [&](const Vec2& p) {
          Vec2 moved = Vec2::Zero();
          moved[i] = p[i] * p[j];  // the other terms of pure bending are the same at every corner
          return moved;
        });
        const double length = sides[i];
        const double width = sides[j];
        const double energy = material.young * length * std::pow(width, 3) / 12;
        EXPECT_NEAR(u.dot(stiffness * u) / energy, 1, 1e-12) << where(material, sides);
      }
    }
  }
}

TEST(Rectangle, OnlyRigidMotionsAreFree) {
  for (const double poisson : {-0.9, -0.2, 0.3, 0.499}) {
    const Material material = test_material(poisson);
    for (const auto& sides : kShapes) {
      const RectangleLaw law = rectangle_law(RectangleModel::kCalibrated, material, sides);
      const Eigen::SelfAdjointEigenSolver<RectangleMatrix> solver(rectangle_hessian(law, rest_corners(law)));
      const double tiny = 1e-10 * solver.eigenvalues().maxCoeff();
      EXPECT_GT(solver.eigenvalues().minCoeff(), -tiny) << where(material, sides);
      EXPECT_EQ((solver.eigenvalues().array() < tiny).count(), 3) << where(material, sides);
    }
  }
}

/// Central differences of relative error about 1e-9 at corners shaken by up to 0.3 of a side.
TEST(Rectangle, ForceAndHessianAreDerivatives) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-0.3, 0.3);
  for (const RectangleModel model : {RectangleModel::kPlain, RectangleModel::kCorrected, RectangleModel::kCalibrated}) {
    const RectangleLaw law = rectangle_law(model, test_material(0.4), {0.12, 0.1});
    for (int trial = 0; trial < 10; ++trial) {
      RectangleVector x = rest_corners(law);
      for (double& coordinate : x) coordinate += 0.1 * share(random);
      const RectangleVector force = rectangle_forces(law, x);
      const RectangleMatrix hessian = rectangle_hessian(law, x);
      const double step = 1e-6;
      RectangleVector slope;
      RectangleMatrix curvature;
      for (int i = 0; i < 8; ++i) {
        const RectangleVector nudge = step * RectangleVector::Unit(i);
        slope[i] = (rectangle_energy(law, x + nudge) - rectangle_energy(law, x - nudge)) / (2 * step);
        curvature.col(i) = (rectangle_forces(law, x - nudge) - rectangle_forces(law, x + nudge)) / (2 * step);
      }
      EXPECT_LT((force + slope).norm(), 1e-7 * force.norm());
      EXPECT_LT((hessian - curvature).norm(), 1e-7 * hessian.norm());
      EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-14 * hessian.norm());
      const Vec2 total = side_forces(force).col(0) + force.segment<2>(0) + force.segment<2>(4);
      EXPECT_LT(total.norm(), 1e-13 * force.norm());
    }
  }
}

}  // namespace
}  // namespace sprung
