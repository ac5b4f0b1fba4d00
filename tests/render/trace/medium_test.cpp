#include "render/trace/medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/trace/body_walk.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

constexpr double kDegree = 3.14159265358979 / 180;

TEST(Medium, FresnelsLawOfASurface) {
  EXPECT_NEAR(fresnel(1, 1.5F), 0.04, 1e-5);                                   // ((n - 1) / (n + 1))^2
  EXPECT_NEAR(fresnel(float(std::cos(56.31 * kDegree)), 1.5F), 0.0740, 1e-3);  // Brewster: half of 0.148
  EXPECT_EQ(fresnel(float(std::cos(42 * kDegree)), 1 / 1.5F), 1);              // beyond 41.8 degrees
  EXPECT_NEAR(fresnel(float(std::cos(30 * kDegree)), 1 / 1.5F),                // the same both ways
              fresnel(float(std::sqrt(1 - 0.75 * 0.75)), 1.5F), 1e-5);
}

/// sin a = n sin b, and parallel again behind a slab.
TEST(Medium, SnellsLawThroughASlab) {
  const Vector3f in(float(std::sin(50 * kDegree)), -float(std::cos(50 * kDegree)), 0);
  const std::optional<Vector3f> inside = refracted(in, Vector3f::UnitY(), 1.4F);
  ASSERT_TRUE(inside);
  EXPECT_NEAR(1.4F * inside->x(), in.x(), 1e-5);
  EXPECT_NEAR(inside->norm(), 1, 1e-6);
  const std::optional<Vector3f> out = refracted(*inside, Vector3f::UnitY(), 1 / 1.4F);
  ASSERT_TRUE(out);
  EXPECT_LT((*out - in).norm(), 1e-5);
  EXPECT_FALSE(refracted(in, Vector3f::UnitY(), 1 / 1.4F));  // total reflection
}

/// Light that enters a cube at a right angle, and of it the part that goes straight through: Beer and Lambert.
TEST(Medium, BeersLawThroughACube) {
  StillLife scene;
  scene.add(make_box_skin({-1, -1, -1}, {1, 1, 1}), kCream);
  const std::vector<SkinShape> shapes = scene.shapes();
  Stage stage = scene.stage();
  stage.mean_free_paths = {2};
  const StageSpace space(stage.bounds);
  TracedSkins skins(stage, space);
  skins.update({&shapes});
  const Media media(stage, space);
  const auto side = float(2 * space.scale);
  const SurfacePoint entry{.color = {0.8F, 0.4F, 0.1F}};
  const Medium medium = media.behind(entry);
  Vector3f straight = Vector3f::Zero();
  constexpr int kSamples = 4096;
  for (int i = 0; i < kSamples; ++i) {
    Sampler sampler(5 * 4096 + std::uint64_t(i));
    const Ray inside{{0.1F, -0.4999F * side, 0.05F}, Vector3f::UnitY()};
    const std::optional<Emergence> out = walk_through_body(skins, media, entry, inside, sampler);
    if (!out || out->is_scattered || out->point.position.y() < 0) continue;
    straight += out->share / kSamples;
    EXPECT_NEAR(out->point.position.x(), 0.1F, 1e-4);
  }
  const float passing = 1 - fresnel(1, 1 / Medium::kIndex);
  const Vector3f expected = passing * medium.transmitted(side);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(straight[k], expected[k], 0.02F * expected[k] + 2e-3F) << k;
}

TEST(Medium, AThickBodyHasItsColour) {
  const Medium white({1, 1, 1}, 3);
  EXPECT_EQ(white.absorption, Vector3f::Zero());
  const Medium red({0.9F, 0.2F, 0.2F}, 3);
  EXPECT_LT(red.absorption[0], 0.1F * red.absorption[1]);
  EXPECT_EQ(Medium({0.9F, 0.2F, 0.2F}, 6).absorption, 2 * red.absorption);
}

}  // namespace
}  // namespace sprung
