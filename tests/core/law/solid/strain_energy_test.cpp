#include "core/law/solid/strain_energy.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/bodies.h"

namespace sprung {
namespace {

using test::material_of_law;

Mat3 random_gradient(double size, std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-size, size);
  return Mat3::Identity() + Mat3::NullaryExpr([&] { return entry(random); });
}

template <class Function>
void for_random_states(const Function& check) {
  std::mt19937 random(5);
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    for (const double poisson : {-0.2, 0.0, 0.3, 0.49}) {
      const Material material = material_of_law(law, poisson);
      const StrainEnergy psi(material);
      for (const double size : {0.01, 0.2, 0.5, 1.0}) {
        SCOPED_TRACE(law_text(law) + " at " + std::to_string(poisson) + ", size " + std::to_string(size));
        for (int trial = 0; trial < 10; ++trial) check(psi, material, random_gradient(size, random));
      }
      // Equal stretches, exactly and almost.
      const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
      check(psi, material, Mat3(turn * Vec3(1.5, 1.5, 0.7).asDiagonal()));
      check(psi, material, Mat3(turn * Vec3(1.5, 1.5 + 1e-7, 0.7).asDiagonal()));
      check(psi, material, turn);
    }
  }
}

TEST(StrainEnergy, HasTheStressThatIsTheSlopeOfTheEnergy) {
  for_random_states([](const StrainEnergy& psi, const Material& material, const Mat3& gradient) {
    constexpr double kStep = 1e-6;
    const Mat3 stress = psi.stress(gradient);
    for (int entry = 0; entry < 9; ++entry) {
      Mat3 step = Mat3::Zero();
      step.reshaped()[entry] = kStep;
      const double slope = (psi.energy(gradient + step) - psi.energy(gradient - step)) / (2 * kStep);
      EXPECT_NEAR(slope, stress.reshaped()[entry], 1e-6 * (stress.norm() + material.young)) << entry;
    }
  });
}

TEST(StrainEnergy, HasTheHessianThatIsTheSlopeOfTheStress) {
  for_random_states([](const StrainEnergy& psi, const Material& material, const Mat3& gradient) {
    constexpr double kStep = 1e-6;
    const GradientMatrix hessian = psi.hessian(gradient);
    EXPECT_LT((hessian - hessian.transpose()).norm(), 1e-12 * hessian.norm());
    for (int entry = 0; entry < 9; ++entry) {
      Mat3 step = Mat3::Zero();
      step.reshaped()[entry] = kStep;
      const Mat3 slope = (psi.stress(gradient + step) - psi.stress(gradient - step)) / (2 * kStep);
      EXPECT_LT((slope.reshaped() - hessian.col(entry)).norm(), 3e-6 * (hessian.norm() + material.young)) << entry;
    }
  });
}

TEST(StrainEnergy, HasADefiniteHessianWithoutTheNegativeEigenvaluesOfTheOther) {
  for_random_states([](const StrainEnergy& psi, const Material& material, const Mat3& gradient) {
    const Eigen::SelfAdjointEigenSolver<GradientMatrix> solver(psi.hessian(gradient));
    const GradientMatrix expected =
        solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
    EXPECT_LT((psi.definite_hessian(gradient) - expected).norm(), 1e-9 * (expected.norm() + material.young));
  });
}

TEST(StrainEnergy, HasTheModuliOfItsMaterialAtRest) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    for (const double poisson : {-0.2, 0.0, 0.3, 0.49, 0.4999}) {
      const Material material = material_of_law(law, poisson);
      const StrainEnergy psi(material);
      EXPECT_EQ(psi.energy(Mat3::Identity()), 0) << law_text(law);
      EXPECT_LT(psi.stress(Mat3::Identity()).norm(), 1e-12 * material.young) << law_text(law);
      const GradientMatrix hessian = psi.hessian(Mat3::Identity());
      for (int entry = 0; entry < 9; ++entry) {
        Mat3 change = Mat3::Zero();
        change.reshaped()[entry] = 1;
        const Mat3 strain = 0.5 * (change + change.transpose());
        const Mat3 hooke =
            material.lame_lambda() * strain.trace() * Mat3::Identity() + 2 * material.shear_modulus() * strain;
        EXPECT_LT((hessian.col(entry) - hooke.reshaped()).norm(), 1e-12 * hessian.norm()) << law_text(law) << poisson;
      }
    }
  }
}

/// The nominal stress along x of a block stretched by `stretch`, sides free, and its sideways stretch.
std::array<double, 2> uniaxial(const StrainEnergy& psi, double stretch) {
  double low = 0.05;
  double high = 3;
  const auto stress = [&](double sideways) -> Vec3 {
    return psi.stress(Vec3(stretch, sideways, sideways).asDiagonal()).diagonal();
  };
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = (low + high) / 2;
    (stress(middle)[1] < 0 ? low : high) = middle;
  }
  return {stress(low)[0], low};
}

TEST(StrainEnergy, IsThePublishedLawWhereVolumeIsKept) {
  constexpr double kPoisson = 0.4999999;
  constexpr double kShear = 1e4 / (2 * (1 + kPoisson));
  const std::array<std::function<double(double)>, 6> published{
      [](double s) { return kShear * (s - 1 / (s * s)); },
      [](double s) { return kShear * (s - 1 / (s * s)) * (0.7 + 0.3 / s); },
      [](double s) { return kShear * (s - 1 / (s * s)) * std::exp(0.4 * (s * s + 2 / s - 3)); },
      [](double s) { return 2 * kShear / 3.5 * (std::pow(s, 2.5) - std::pow(s, -2.75)); },
      [](double s) {
        return 2 * kShear * 0.75 / 1.3 * (std::pow(s, 0.3) - std::pow(s, -1.65)) +
               2 * kShear * 0.05 / 5 * (std::pow(s, 4) - std::pow(s, -3.5)) -
               2 * kShear * 0.2 / 2 * (std::pow(s, -3) - 1);
      },
      nullptr};
  for (std::size_t row = 0; row < published.size(); ++row) {
    if (!published[row]) continue;
    const StrainEnergy psi(material_of_law(test::kStrainEnergyLaws[row], kPoisson));
    for (const double stretch : {0.5, 0.8, 1.5, 2.0}) {
      const double expected = published[row](stretch);
      EXPECT_NEAR(uniaxial(psi, stretch)[0], expected, 1e-5 * std::abs(expected)) << row << ' ' << stretch;
    }
  }
}

TEST(StrainEnergy, OfTheLinearLawIsThatOfStVenantAndKirchhoff) {
  const Material material = material_of_law({.kind = StrainEnergyKind::kLinear}, 0.3);
  for (const double stretch : {0.7, 1.2, 1.5}) {
    const auto [stress, sideways] = uniaxial(StrainEnergy(material), stretch);
    EXPECT_NEAR(stress, material.young * stretch * (stretch * stretch - 1) / 2, 1e-9 * material.young);
    EXPECT_NEAR(sideways * sideways, 1 - 0.3 * (stretch * stretch - 1), 1e-9);
  }
}

/// Its exponential stiffens the response to changes of volume as that to shear: a bar thins as a neo-Hookean one does.
TEST(StrainEnergy, OfFungStiffensWithoutChangingHowABarThins) {
  const StrainEnergy plain(material_of_law({}, 0.35));
  const StrainEnergy fung(material_of_law({.kind = StrainEnergyKind::kFung, .fung_exponent = 2}, 0.35));
  for (const double stretch : {0.7, 1.5, 2.0}) {
    const auto [plain_stress, plain_sideways] = uniaxial(plain, stretch);
    const auto [stress, sideways] = uniaxial(fung, stretch);
    EXPECT_NEAR(sideways, plain_sideways, 1e-9) << stretch;
    EXPECT_GT(stress / plain_stress, 1.2) << stretch;
  }
}

/// Up to 400 times the stiffness at rest, to the exponent 6; from there on its tangent modulus by W grows no more.
TEST(StrainEnergy, OfFungIsExponentialUpToFourHundredTimesTheStiffness) {
  constexpr double kExponent = 0.4;
  const Material material = material_of_law({.kind = StrainEnergyKind::kFung, .fung_exponent = kExponent}, 0.3);
  const StrainEnergy plain(material_of_law({}, 0.3));
  const StrainEnergy fung(material);
  const double per_energy = 2 * kExponent / material.shear_modulus();
  for (double stretch = 1.5; stretch < 4.5; stretch += 0.1) {
    const Mat3 gradient = Vec3(stretch, 1, 1).asDiagonal();
    const double power = per_energy * plain.energy(gradient);
    const double beyond = power - 6;
    const double expected = beyond < 0 ? std::exp(power) : 403.428793 * (1 + beyond + beyond * beyond / 2);
    EXPECT_NEAR((1 + per_energy * fung.energy(gradient)) / expected, 1, 1e-8) << stretch;
  }
}

/// With a negative exponent, which makes most of small stretches: down to 1/10 as published, then a linear spring.
TEST(StrainEnergy, OfOgdenIsThePublishedLawDownToATenthOfTheLength) {
  const StrainEnergyLaw law{.kind = StrainEnergyKind::kOgden, .ogden_exponents = {5, -2}, .ogden_shares = {0.9, 0.1}};
  const Material material = material_of_law(law, 0);  // lambda = 0: only log J stands besides the stretches
  const StrainEnergy psi(material);
  const double shear = material.shear_modulus();
  const auto pull = [&](double s) {
    return 2 * shear * (0.9 / 5 * std::pow(s, 4) - 0.1 / 2 * std::pow(s, -3) - (0.9 / 5 - 0.1 / 2) / s);
  };
  for (const double s : {0.5, 0.1005, 0.1})
    EXPECT_NEAR(psi.principal_stress(Vec3(s, 2, 2))[0] / pull(s), 1, 1e-12) << s;
  const auto spring = [&](double s) {
    return psi.principal_stress(Vec3(s, 2, 2))[0] + 2 * shear * (0.9 / 5 - 0.1 / 2) / s;
  };
  for (const double s : {0.09, 0.05, 0.03}) EXPECT_NEAR(spring(s) / spring(0.1), 10 * s, 1e-12) << s;
}

TEST(StrainEnergy, IsFiniteForEveryGradient) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    const StrainEnergy psi(material_of_law(law, 0.45));
    for (const double size : {-1000.0, -1.0, 0.0, 1e-9, 1000.0}) {
      EXPECT_TRUE(std::isfinite(psi.energy(size * Mat3::Identity()))) << law_text(law) << size;
      EXPECT_TRUE(psi.stress(size * Mat3::Identity()).allFinite()) << law_text(law) << size;
      EXPECT_TRUE(psi.definite_hessian(size * Mat3::Identity()).allFinite()) << law_text(law) << size;
    }
  }
}

TEST(StrainEnergy, ResistsHoweverFarItIsStretched) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    for (const double poisson : {-0.5, -0.2, 0.0, 0.45}) {
      const StrainEnergy psi(material_of_law(law, poisson));
      double least = 0;
      for (double stretch = 1.01; stretch < 5; stretch += 0.01) {
        const double energy = psi.energy(stretch * Mat3::Identity());
        EXPECT_GT(energy, least) << law_text(law) << ' ' << poisson << ' ' << stretch;
        least = energy;
      }
    }
  }
}

TEST(StrainEnergy, BearsEveryLoadInCompression) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    if (law.kind == StrainEnergyKind::kLinear) continue;  // gives way, see StrainEnergyKind
    for (const double poisson : {0.0, 0.2, 0.3, 0.45}) {
      const StrainEnergy psi(material_of_law(law, poisson));
      double least = 0;
      const double least_stretch = law.kind == StrainEnergyKind::kOgden ? 0.1 : 0.05;
      for (double stretch = 0.99; stretch > least_stretch; stretch -= 0.01) {
        // Confined, the least support of a solid with free sides.
        const double stress = psi.stress(Vec3(stretch, 1, 1).asDiagonal())(0, 0);
        EXPECT_LT(stress, least) << law_text(law) << ' ' << poisson << ' ' << stretch;
        least = stress;
      }
    }
  }
}

TEST(StrainEnergyLaw, TellsWhatIsWrongWithItsParameters) {
  const auto fault = [](const StrainEnergyLaw& law) { return find_fault(law); };
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) EXPECT_EQ(fault(law), "");
  EXPECT_EQ(fault({.kind = StrainEnergyKind::kFung}), "law fung needs fung_exponent, above 0");
  EXPECT_EQ(fault({.kind = StrainEnergyKind::kMooneyRivlin, .mooney_share = 1.5}),
            "mooney_share is 1.5, it must be from 0 to 1");
  EXPECT_EQ(fault({.mooney_share = 0.5}),
            "mooney_share is of law mooney-rivlin, not neo-hooke; leave it out or change the law");
  EXPECT_EQ(fault({.kind = StrainEnergyKind::kOgden, .ogden_exponents = {2, -2}, .ogden_shares = {0.5, 0.4}}),
            "ogden_shares add up to 0.9; they must add up to 1");
  EXPECT_NE(fault({.kind = StrainEnergyKind::kOgden, .ogden_exponents = {2, -2}}).find("ogden_shares has 0"),
            std::string::npos);
  EXPECT_NE(fault({.kind = StrainEnergyKind::kOgden, .ogden_exponents = {-2}}).find("pressed flat"), std::string::npos);
}

TEST(StrainEnergyLaw, TakesParametersWithinTheirRangesOnly) {
  const auto share = [](double c) { return find_fault({.kind = StrainEnergyKind::kMooneyRivlin, .mooney_share = c}); };
  const auto fung = [](double b) { return find_fault({.kind = StrainEnergyKind::kFung, .fung_exponent = b}); };
  const auto ogden = [](double alpha, double sum) {
    return find_fault({.kind = StrainEnergyKind::kOgden, .ogden_exponents = {alpha}, .ogden_shares = {sum}});
  };
  for (const double c : {0.0, 1.0}) EXPECT_EQ(share(c), "") << c;
  for (const double c : {-0.001, 1.001}) EXPECT_NE(share(c), "") << c;
  for (const double b : {1e-6, 100.0}) EXPECT_EQ(fung(b), "") << b;
  for (const double b : {0.0, 0.999e-6, 100.1}) EXPECT_NE(fung(b), "") << b;
  for (const double alpha : {0.01, 100.0}) EXPECT_EQ(ogden(alpha, 1), "") << alpha;
  for (const double alpha : {0.00999, 100.1, -100.1}) EXPECT_NE(ogden(alpha, 1), "") << alpha;
  for (const double sum : {1 - 0.999e-6, 1 + 0.999e-6}) EXPECT_EQ(ogden(2, sum), "") << sum;
  for (const double sum : {1 - 1.001e-6, 1 + 1.001e-6}) EXPECT_NE(ogden(2, sum), "") << sum;
}

}  // namespace
}  // namespace sprung
