#include "core/world/keyframes.h"

#include <gtest/gtest.h>

#include <random>

namespace sprung {
namespace {

std::vector<Keyframe> random_keyframes(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vec3(number(random), number(random), number(random)); };
  std::vector<Keyframe> keyframes(1);
  for (int i = 0; i < 4; ++i) {
    keyframes.push_back({.time = keyframes.back().time + 0.6 + 0.5 * number(random),
                         .translate = vector(),
                         .rotate = 200 * vector(),
                         .scale = 1.5 + number(random)});
  }
  return keyframes;
}

Vec3 placed(const Movement& movement, double time, const Vec3& arm) { return arm + movement.placement(time).way(arm); }

TEST(Keyframes, WithoutAnyNothingMoves) {
  const Movement movement;
  EXPECT_TRUE(movement.is_still());
  EXPECT_EQ(movement.placement(3).way(Vec3(1, 2, 3)), Vec3::Zero());
  EXPECT_TRUE(Movement({Keyframe{}, {.time = 1}}, Interpolation::kSmooth).is_still());
}

TEST(Keyframes, LinearGoesEvenlyFromThePlaceAtTheStartAndStaysAtTheEnd) {
  const Movement movement({{.time = 2, .translate = Vec3(4, 0, 0), .scale = 3}}, Interpolation::kLinear);
  EXPECT_EQ(movement.placement(0).shift, Vec3::Zero());
  EXPECT_EQ(movement.placement(0.5).shift, Vec3(1, 0, 0));
  EXPECT_DOUBLE_EQ(movement.placement(0.5).scale, 1.5);
  EXPECT_EQ(movement.placement(7).shift, Vec3(4, 0, 0));
  EXPECT_EQ(movement.rate(1).shift, Vec3(2, 0, 0));
  EXPECT_EQ(movement.rate(2).shift, Vec3::Zero());
  EXPECT_FALSE(movement.is_still());
}

TEST(Keyframes, HeldJumps) {
  const Movement movement({{.time = 1, .translate = Vec3(1, 0, 0)}, {.time = 2, .translate = Vec3(5, 0, 0)}},
                          Interpolation::kHeld);
  EXPECT_EQ(movement.placement(0.999).shift, Vec3::Zero());
  EXPECT_EQ(movement.placement(1).shift, Vec3(1, 0, 0));
  EXPECT_EQ(movement.placement(1.999).shift, Vec3(1, 0, 0));
  EXPECT_EQ(movement.rate(1.5).shift, Vec3::Zero());
}

TEST(Keyframes, ManyTurnsAreTurned) {
  const Movement movement({{.time = 4, .rotate = Vec3(0, 720, 0)}}, Interpolation::kLinear);
  EXPECT_LT((placed(movement, 0.5, Vec3(1, 0, 0)) - Vec3(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((placed(movement, 4, Vec3(1, 0, 0)) - Vec3(1, 0, 0)).norm(), 1e-12);
}

/// Through every keyframe, between its neighbours' values, at rest at both ends, without corners.
TEST(Keyframes, SmoothNeverOvershootsAndHasNoCorners) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    const Movement movement(random_keyframes(random), Interpolation::kSmooth);
    const std::vector<Keyframe>& keyframes = movement.keyframes();
    EXPECT_EQ(movement.rate(0).shift, Vec3::Zero());
    EXPECT_LT(movement.rate(keyframes.back().time - 1e-9).shift.norm(), 1e-6);
    for (std::size_t i = 1; i < keyframes.size(); ++i) {
      const double begin = keyframes[i - 1].time;
      const double end = keyframes[i].time;
      EXPECT_LT((movement.placement(end).shift - keyframes[i].translate).norm(), 1e-12);
      EXPECT_LT((movement.rate(end - 1e-9).shift - movement.rate(end).shift).norm(), 1e-6);
      const Vec3 low = keyframes[i - 1].translate.cwiseMin(keyframes[i].translate);
      const Vec3 high = keyframes[i - 1].translate.cwiseMax(keyframes[i].translate);
      for (double time = begin; time < end; time += (end - begin) / 50) {
        const Vec3 shift = movement.placement(time).shift;
        EXPECT_TRUE((shift.array() >= low.array() - 1e-12).all() && (shift.array() <= high.array() + 1e-12).all());
      }
    }
  }
}

TEST(Keyframes, VelocitiesAreTheDerivativesOfPlaces) {
  std::mt19937 random(6);
  const Vec3 arm(0.3, -0.2, 0.5);
  constexpr double kStep = 1e-6;
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kSmooth}) {
    for (int round = 0; round < 20; ++round) {
      const Movement movement(random_keyframes(random), interpolation);
      for (const double time : {0.04, 0.7, 1.3}) {
        const Vec3 moved = placed(movement, time, arm) - movement.placement(time).shift;
        const Vec3 difference =
            (placed(movement, time + kStep, arm) - placed(movement, time - kStep, arm)) / (2 * kStep);
        EXPECT_LT((movement.rate(time).velocity(moved) - difference).norm(), 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace sprung
