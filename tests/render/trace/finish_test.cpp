#include "render/trace/finish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/trace/directions.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;
const Vector3f kWhite = Vector3f::Ones();

Vector3f direction(float cosine, float turn) {
  const float sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

/// The mean of f over directions of the hemisphere at equal steps of cosine and turn, times its solid angle.
template <class Function>
double integral(const Function& f) {
  constexpr int kCosines = 1000;
  constexpr int kTurns = 500;
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    for (int j = 0; j < kTurns; ++j) {
      sum += f(direction((float(i) + 0.5F) / kCosines, 2 * kPi * (float(j) + 0.5F) / kTurns));
    }
  }
  return 2 * double{kPi} * sum / (kCosines * kTurns);
}

double reflected(const Finish& finish, float cosine, const Vector3f& color) {
  return integral([&](const Vector3f& to_light) {
    const Reflected share = finish.respond(direction(cosine, 0), to_light, color).reflected;
    return double{color.x()} * double{share.base.x()} + double{share.specular.x()};
  });
}

TEST(Finish, AWhiteSurfaceAbsorbsNothing) {
  for (const float cosine : {1.0F, 0.7F, 0.3F}) {
    for (const float roughness : {0.35F, 0.6F, 0.9F}) {
      EXPECT_NEAR(reflected(Finish({.roughness = roughness}), cosine, kWhite), 1, 0.01) << roughness << ' ' << cosine;
      EXPECT_NEAR(reflected(Finish({.roughness = roughness, .is_metal = true}), cosine, kWhite), 1, 0.01)
          << roughness << ' ' << cosine;
    }
    EXPECT_NEAR(reflected(Finish::matt(), cosine, kWhite), 1, 0.001);
  }
}

TEST(Finish, NoLookReflectsMoreThanItGets) {
  for (const Look look : {Look::kPlastic, Look::kGelatin, Look::kRubber, Look::kSteel, Look::kChart}) {
    for (const float cosine : {1.0F, 0.5F, 0.1F}) {
      const double grey = reflected(Finish::of(look), cosine, Vector3f::Constant(0.5F));
      EXPECT_LT(grey, 0.9);
      EXPECT_GT(grey, 0.3);
    }
  }
}

/// H. von Helmholtz: light paths are reversible.
TEST(Finish, IsReciprocal) {
  for (const Look look : {Look::kPlastic, Look::kRubber}) {
    const Finish finish = Finish::of(look);
    const Vector3f a = direction(0.9F, 0.3F);
    const Vector3f b = direction(0.35F, 2);
    const Reflected there = finish.respond(a, b, kWhite).reflected;
    const Reflected back = finish.respond(b, a, kWhite).reflected;
    EXPECT_NEAR(there.base.x() / b.z(), back.base.x() / a.z(), 1e-5);
    EXPECT_NEAR(there.specular.x() / b.z(), back.specular.x() / a.z(), 1e-5);
  }
}

TEST(Finish, DensitiesAreThoseOfTheSamples) {
  constexpr int kSide = 300;
  for (const float cosine : {0.95F, 0.4F}) {
    const Finish finish = Finish::of(Look::kPlastic);
    const Vector3f to_eye = direction(cosine, 1);
    double above = 0;
    double mean_height = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      for (const float choice : {0.05F, 0.15F, 0.25F, 0.35F, 0.45F, 0.55F, 0.65F, 0.75F, 0.85F, 0.95F}) {
        const Vector3f next = finish.sample(to_eye, on_grid(i, kSide), choice);
        if (next.z() <= 0) continue;
        above += 0.1;
        mean_height += 0.1 * double{next.z()};
      }
    }
    const auto density = [&](const Vector3f& next) { return double{finish.respond(to_eye, next, kWhite).density}; };
    const double whole = integral(density);
    const double height = integral([&](const Vector3f& next) { return double{next.z()} * density(next); });
    EXPECT_NEAR(above / (kSide * kSide), whole, 0.005) << cosine;
    EXPECT_NEAR(mean_height / (kSide * kSide), height, 0.005) << cosine;
  }
}

TEST(Finish, AMirrorReflectsToTheOtherSide) {
  const Finish mirror({.roughness = 0.02F, .is_metal = true});
  const Vector3f next = mirror.sample(direction(0.6F, 0), {0.4F, 0.7F}, 0.5F);
  EXPECT_LT((next - direction(0.6F, kPi)).norm(), 0.01);
}

/// Reflects (n - 1)^2 / (n + 1)^2 at normal incidence, everything at grazing incidence.
TEST(Finish, FresnelsLawAtItsEnds) {
  const Finish glossy({.roughness = 0.2F});
  const double at_right_angles = reflected(glossy, 1, Vector3f::Zero());
  EXPECT_NEAR(at_right_angles, 0.04, 0.002);
  EXPECT_GT(reflected(glossy, 0.1F, Vector3f::Zero()), 0.4);
}

}  // namespace
}  // namespace sprung
