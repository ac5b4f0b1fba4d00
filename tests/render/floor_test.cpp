#include "render/stage/floor.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

using Albedo = Eigen::Vector3f;

TEST(Floor, OnlySomeKindsHaveAPattern) {
  EXPECT_FALSE(floor_of(FloorKind::kSweep, 1).pattern);
  EXPECT_FALSE(floor_of(FloorKind::kPlain, 1).pattern);
  EXPECT_FALSE(floor_of(FloorKind::kSweep, 1).has_horizon);
  EXPECT_TRUE(floor_of(FloorKind::kPlain, 1).has_horizon);
}

// Squares of 30 cm: neighbours differ, diagonal ones do not.
TEST(Floor, AStatedSizeIsThatOfASquare) {
  const std::shared_ptr<const FloorPattern> kept = floor_of(FloorKind::kChecker, 0.3).pattern;
  const FloorPattern& pattern = *kept;
  const Albedo first = pattern.albedo(0.15, 0.15);
  EXPECT_GT((pattern.albedo(0.45, 0.15) - first).norm(), 0.2);
  EXPECT_GT((pattern.albedo(0.15, -0.15) - first).norm(), 0.2);
  EXPECT_EQ(pattern.albedo(0.45, 0.45), first);
  EXPECT_EQ(pattern.albedo(-0.45, -0.45), first);
  EXPECT_NEAR(pattern.albedo(0.01, 0.15).x(), first.x(), 1e-6);
  EXPECT_GT((pattern.albedo(-0.01, 0.15) - first).norm(), 0.2);
}

TEST(Floor, ItsMeanIsThatOfAllPlaces) {
  for (const FloorKind kind : {FloorKind::kChecker, FloorKind::kWood}) {
    const std::shared_ptr<const FloorPattern> kept = floor_of(kind, 0.1).pattern;
    const FloorPattern& pattern = *kept;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    constexpr int kSide = 400;
    for (int i = 0; i < kSide * kSide; ++i) {
      const double x = (i % kSide + 0.5) / kSide * pattern.sides.x();
      const double z = (i / kSide + 0.5) / kSide * pattern.sides.y();
      sum += pattern.albedo(x, z).cast<double>();
    }
    EXPECT_LT((sum / (kSide * kSide) - pattern.mean.cast<double>()).norm(), 0.003) << int(kind);
  }
}

// Also at the seam, where the joints of boards are the only jumps.
TEST(Floor, BoardsRepeat) {
  const std::shared_ptr<const FloorPattern> kept = floor_of(FloorKind::kWood, 0.1).pattern;
  const FloorPattern& pattern = *kept;
  for (double x = 0.013; x < 1.2; x += 0.07) {
    EXPECT_LT((pattern.albedo(x, 0.23) - pattern.albedo(x - pattern.sides.x(), 0.23 + pattern.sides.y())).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace sprung
