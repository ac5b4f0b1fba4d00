#include "core/law/solid/solid_brick.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/bodies.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

constexpr double kSide = 0.05;

using Random = std::mt19937;

double between(double low, double high, Random& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Mat3 random_matrix(double size, Random& random) {
  return Mat3::NullaryExpr([&] { return between(-size, size, random); });
}

/// Moments of points anywhere in the brick.
SolidMoments random_moments(Random& random) {
  SolidIntegrals sum;
  for (int i = 0; i < 4; ++i) {
    const SolidMoments point{.centroid = random_matrix(0.5, random).col(0), .covariance = 1e-4 * Mat3::Identity()};
    sum += integrals_of(between(0.1, 1, random), point);
  }
  return sum.moments();
}

BrickVector rest_corners(double h) { return Eigen::Map<const BrickVector>(test::rest_brick(h).data()).array() - h / 2; }

BrickVector deformed(const Mat3& gradient, double h) { return (gradient * rest_corners(h).reshaped(3, 8)).reshaped(); }

BrickVector shaken(double amount, double h, Random& random) {
  return rest_corners(h) + BrickVector::NullaryExpr([&] { return between(-amount * h, amount * h, random); });
}

TEST(SolidBrick, IsWhatTheOracleSays) {
#ifndef SPRUNG_ORACLE_PYTHON
  GTEST_SKIP() << "built without Python";
#else
  Random random(1);
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "bricks.txt";
  std::ofstream out(file);
  out.precision(17);
  for (int brick = 0; brick < 60; ++brick) {
    const double h = std::pow(10, between(-3, 0, random));
    const double fill = between(0.01, 1.1, random);
    const Material material = test::test_material(between(-0.3, 0.499, random), std::pow(10, between(3, 9, random)));
    const SolidMoments moments = bounded_moments(random_moments(random));
    const BrickVector x = shaken(brick % 3 == 0 ? 0.05 : brick % 3 == 1 ? 0.3 : 1.0, h, random);
    const SolidBrick solid(material, h, fill, moments);
    const double volume = fill * h * h * h;
    const Mat3 second = volume * h * h * moments.covariance;
    const auto write = [&](const auto& values) {
      for (const double value : values.reshaped()) out << value << ' ';
    };
    out << material.young << ' ' << material.poisson << ' ' << h << ' ' << volume << ' ';
    write(moments.centroid);
    write(second);
    const BrickVector u = shaken(1, 1, random);
    write(x);
    write(u);
    out << solid.energy(x) << ' ';
    write(solid.forces(x));
    write(solid.hessian(x, false) * u);
    out << '\n';
  }
  out.close();
  const std::string command = SPRUNG_ORACLE_PYTHON " " SPRUNG_SOURCE_DIR "/tests/core/law/solid/oracle.py";
  EXPECT_EQ(std::system(fmt::format("{} {}", command, file.string()).c_str()), 0);
  EXPECT_EQ(std::system(command.c_str()), 0) << "the oracle contradicts itself";
#endif
}

TEST(SolidBrick, AnswersUniformStrainAsItsMaterial) {
  Random random(2);
  for (const double poisson : {-0.2, 0.0, 0.3, 0.49, 0.4999}) {
    const Material material = test::test_material(poisson);
    const StrainEnergy law(material);
    for (int trial = 0; trial < 100; ++trial) {
      const double fill = between(0.05, 1, random);
      const double volume = fill * kSide * kSide * kSide;
      const SolidBrick brick(material, kSide, fill, random_moments(random));
      const Mat3 gradient = Mat3::Identity() + random_matrix(0.8, random);
      const BrickVector x = deformed(gradient, kSide);
      EXPECT_LT((brick.gradient(x) - gradient).norm(), 1e-12);
      const double energy = law.energy(gradient);
      EXPECT_NEAR(brick.energy(x) / (volume * energy), 1, 1e-12 * (1 + material.young / energy));
      const Mat3 virial = -brick.forces(x).reshaped(3, 8) * rest_corners(kSide).reshaped(3, 8).transpose();
      const Mat3 expected = volume * law.stress(gradient);
      EXPECT_LT((virial - expected).norm(), 1e-12 * (expected.norm() + volume * material.young));
    }
  }
}

TEST(SolidBrick, OfEveryLawAnswersUniformStrainAsItsMaterial) {
  Random random(7);
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    const Material material = test::material_of_law(law, 0.3);
    const StrainEnergy psi(material);
    for (int trial = 0; trial < 10; ++trial) {
      const double volume = 0.4 * kSide * kSide * kSide;
      const SolidBrick brick(material, kSide, 0.4, random_moments(random));
      const Mat3 gradient = Mat3::Identity() + random_matrix(0.4, random);
      const BrickVector x = deformed(gradient, kSide);
      EXPECT_NEAR(brick.energy(x) / (volume * psi.energy(gradient)), 1, 1e-10) << law_text(law);
      const Mat3 virial = -brick.forces(x).reshaped(3, 8) * rest_corners(kSide).reshaped(3, 8).transpose();
      EXPECT_LT((virial - volume * psi.stress(gradient)).norm(), 1e-10 * virial.norm()) << law_text(law);
    }
  }
}

TEST(SolidBrick, HasForcesVolumeRatesAndHessianThatAreDerivatives) {
  Random random(3);
  const StrainEnergyLaw fung{.kind = StrainEnergyKind::kFung, .fung_exponent = 0.4};
  for (const double amount : {0.1, 0.4, 1.0}) {
    for (const Material& material : {test::test_material(0), test::test_material(0.3), test::test_material(0.49),
                                     test::material_of_law(fung, 0.3)}) {
      const SolidBrick brick(material, kSide, 0.4, random_moments(random));
      const BrickVector x = shaken(amount, kSide, random);
      BrickVector slope;
      BrickVector volume_slope;
      BrickMatrix change;
      const double step = 1e-6 * kSide;
      for (int i = 0; i < 24; ++i) {
        BrickVector high = x;
        BrickVector low = x;
        high[i] += step;
        low[i] -= step;
        slope[i] = -(brick.energy(high) - brick.energy(low)) / (2 * step);
        volume_slope[i] = (brick.gradient(high).determinant() - brick.gradient(low).determinant()) / (2 * step);
        change.col(i) = -(brick.forces(high) - brick.forces(low)) / (2 * step);
      }
      EXPECT_LT((brick.forces(x) - slope).norm(), 1e-7 * slope.norm());
      EXPECT_LT((brick.volume_rates(x) - volume_slope).norm(), 1e-7 * volume_slope.norm());
      EXPECT_LT((brick.hessian(x, false) - change).norm(), 1e-7 * change.norm());
    }
  }
}

TEST(SolidBrick, KeepsMomentum) {
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const SolidBrick brick(test::test_material(0.4), kSide, 0.5, random_moments(random));
    const BrickVector x = shaken(0.5, kSide, random);
    const BrickVector v = shaken(1, kSide, random);
    for (const BrickVector& force : {brick.forces(x), brick.damping_product(x, v)}) {
      Vec3 sum = Vec3::Zero();
      Vec3 moment = Vec3::Zero();
      for (int c = 0; c < 24; c += 3) {
        sum += force.segment<3>(c);
        moment += Vec3(x.segment<3>(c)).cross(Vec3(force.segment<3>(c)));
      }
      EXPECT_LT(sum.norm(), 1e-13 * force.norm());
      EXPECT_LT(moment.norm(), 1e-13 * force.norm() * kSide);
    }
  }
}

TEST(SolidBrick, DampsDeformationOnly) {
  Random random(5);
  const Material material = test::test_material(0.4);
  for (int trial = 0; trial < 20; ++trial) {
    const SolidBrick brick(material, kSide, 0.5, bounded_moments(random_moments(random)));
    const BrickVector x = shaken(0.5, kSide, random);
    const BrickMatrix damping = brick.damping(x);
    const BrickVector v = shaken(1, kSide, random);
    EXPECT_LT((damping * v - brick.damping_product(x, v)).norm(), 1e-12 * (damping * v).norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<BrickMatrix>(damping).eigenvalues()[0], -1e-12 * damping.norm());
    BrickVector spin;
    for (int c = 0; c < 24; c += 3) spin.segment<3>(c) = Vec3(1, 2, 3) + Vec3(4, -5, 6).cross(Vec3(x.segment<3>(c)));
    EXPECT_LT(brick.damping_product(x, spin).norm(), 1e-12 * damping.norm() * spin.norm());
  }
  const SolidBrick brick(material, kSide, 0.5, random_moments(random));
  const BrickMatrix hessian = brick.hessian(rest_corners(kSide), false);
  EXPECT_LT((brick.damping(rest_corners(kSide)) - hessian).norm(), 1e-12 * hessian.norm());
}

TEST(SolidBrick, HasADefiniteHessianToo) {
  Random random(6);
  for (const double amount : {0.1, 0.5, 1.5}) {
    for (const double poisson : {-0.2, 0.0, 0.3, 0.49}) {
      const Material material = test::test_material(poisson);
      const SolidBrick brick(material, kSide, 0.4, bounded_moments(random_moments(random)));
      const BrickMatrix definite = brick.hessian(shaken(amount, kSide, random), true);
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<BrickMatrix>(definite).eigenvalues()[0], -1e-12 * definite.norm());
    }
  }
  // If nothing is negative, nothing is changed.
  const SolidBrick brick(test::test_material(0.3), kSide, 1, {});
  const BrickVector x = deformed(1.1 * Mat3::Identity(), kSide);
  EXPECT_LT((brick.hessian(x, true) - brick.hessian(x, false)).norm(), 1e-12 * brick.hessian(x, false).norm());
}

/// A plate's points are spread across it as t^2 / 12.
TEST(SolidBrick, TakesSolidsForNoThinnerThanATinyPlateNorFartherFromTheMiddleThanItsCorners) {
  const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const auto& [thickness, taken] : {std::pair(0.5, 0.5), {0.02001, 0.02001}, {0.01999, 0.02}, {0.001, 0.02}}) {
    const auto plate = [&](double t) -> Mat3 {
      return turn * (Vec3(t * t, 1, 1) / 12).asDiagonal() * turn.transpose();
    };
    const Mat3 bounded = bounded_moments({.covariance = plate(thickness)}).covariance;
    EXPECT_LT((bounded - plate(taken)).norm(), 1e-9) << thickness;
  }
  const Vec3 centroid = bounded_moments({.centroid = Vec3(0.4499, -0.7, 0.7)}).centroid;
  EXPECT_LT((centroid - Vec3(0.4499, -0.45, 0.45)).norm(), 1e-12);
}

TEST(SolidBrick, IsStableHoweverThinARodItHolds) {
  for (const double poisson : {0.0, 0.3, 0.49}) {
    const Material material = test::test_material(poisson);
    const SolidMoments rod{.covariance = Mat3::Constant(1.0 / 12)};
    const BrickMatrix hessian =
        SolidBrick(material, kSide, 0.02, bounded_moments(rod)).hessian(rest_corners(kSide), false);
    const auto values = Eigen::SelfAdjointEigenSolver<BrickMatrix>(hessian).eigenvalues();
    EXPECT_GT(values[0], -1e-10 * values[23]) << poisson;
    EXPECT_GT(values[6], 0) << poisson;
  }
}

}  // namespace
}  // namespace sprung
