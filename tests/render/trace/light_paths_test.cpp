#include "render/trace/light_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/trace/directions.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

using Eigen::Vector3f;

const Eigen::Vector3f kWhitePaint(1, 1, 1);
constexpr std::array kLooks{Look::kPlastic, Look::kGelatin, Look::kRubber, Look::kSteel};

Finishes all_of(const Finish& finish) { return {finish, finish, finish, finish, finish}; }

/// The mean light along rays of a few samples.
Vector3f mean_light(const LightPaths& paths, const Ray& ray, int samples) {
  Vector3f sum = Vector3f::Zero();
  for (int i = 0; i < samples; ++i) {
    Sampler sampler(7 * 4096 + std::uint64_t(i));
    sum += paths.arriving(ray, sampler);
  }
  return sum / float(samples);
}

/// Towards a point of a ball of radius 1 around the origin, from above the point.
Ray towards(const Vector3f& point, const Vector3f& from) { return {from, (point - from).normalized()}; }

struct Ball {
  StillLife scene;
  std::vector<SkinShape> shapes;

  explicit Ball(const Vector3f& color) {
    scene.has_ground = false;
    scene.add(make_sphere_skin(Vec3::Zero(), 1), color);
    shapes = scene.shapes();
  }
  [[nodiscard]] float scale() const { return float(StageSpace(scene.stage().bounds).scale); }
};

/// The white furnace: in uniform light a white body cannot be distinguished from the background.
TEST(LightPaths, AWhiteBodyDisappearsInAnEvenLight) {
  const Ball ball(kWhitePaint);
  for (const Look look : kLooks) {
    Stage stage = ball.scene.stage();
    stage.looks = {look};
    LightPaths paths(stage, StageLight::even({1, 1, 1}), all_of(Finish::of(look)));
    paths.update({&ball.shapes});
    for (const float height : {0.0F, 0.3F, 0.55F}) {  // in stage space the radius is 0.58
      const Vector3f light = mean_light(paths, {{0, height, 3}, {0, 0, -1}}, 1024);
      EXPECT_NEAR(light.y(), 1, 0.02) << int(look) << ' ' << height;
    }
  }
}

/// White gelatin, which light enters and leaves, does not absorb it either.
TEST(LightPaths, AWhiteTranslucentBodyDisappearsToo) {
  const Ball ball(kWhitePaint);
  for (const double mean_free_path : {0.1, 1.0, 10.0}) {
    Stage stage = ball.scene.stage();
    stage.looks = {Look::kGelatin};
    stage.mean_free_paths = {mean_free_path};
    LightPaths paths(stage, StageLight::even({1, 1, 1}), all_of(Finish::of(Look::kGelatin)));
    paths.update({&ball.shapes});
    for (const float height : {0.0F, 0.3F}) {
      EXPECT_NEAR(mean_light(paths, {{0, height, 3}, {0, 0, -1}}, 1024).y(), 1, 0.02) << mean_free_path;
    }
  }
}

/// A ball of the same colour is lighter if light passes through it more easily.
TEST(LightPaths, TranslucentBodiesAreOfTheirColourWhereTheyAreThick) {
  const Ball ball({0.9F, 0.4F, 0.3F});
  const auto light = [&](double mean_free_path) {
    Stage stage = ball.scene.stage();
    stage.mean_free_paths = {mean_free_path};
    LightPaths paths(stage, StageLight::even({1, 1, 1}), all_of(Finish::of(Look::kGelatin)));
    paths.update({&ball.shapes});
    constexpr int kRays = 24;  // evenly over the ball's disc: in uniform light it looks the same from all sides
    Vector3f sum = Vector3f::Zero();
    for (int i = 0; i < kRays; ++i) {
      const float height = 0.577F * std::sqrt((float(i) + 0.5F) / kRays);
      sum += mean_light(paths, {{0, height, 3}, {0, 0, -1}}, 512);
    }
    return (sum / kRays).eval();
  };
  const Vector3f opaque = light(0);
  const Vector3f thick = light(0.01);
  const Vector3f thin = light(2);
  EXPECT_LT((thick - opaque).cwiseAbs().maxCoeff(), 0.02F) << thick.transpose() << " / " << opaque.transpose();
  EXPECT_GT(thin.y(), opaque.y() + 0.1F);
}

/// A ball of radius 0.6 inside one of radius 1, both translucent.
struct CherryInJelly {
  StillLife scene;

  explicit CherryInJelly(const Vector3f& cherry, bool is_first = false) {
    scene.has_ground = false;
    if (is_first) scene.add(make_sphere_skin(Vec3::Zero(), 0.6), cherry);
    scene.add(make_sphere_skin(Vec3::Zero(), 1), kCream);
    if (!is_first) scene.add(make_sphere_skin(Vec3::Zero(), 0.6), cherry);
  }
  /// Aimed at the middle, under the studio's light.
  [[nodiscard]] Vector3f light() const {
    const std::vector<SkinShape> shapes = scene.shapes();
    Stage stage = scene.stage();
    stage.looks = {Look::kGelatin, Look::kGelatin};
    stage.mean_free_paths = {0.5, 0.5};
    LightPaths paths(stage);
    paths.update({&shapes});
    return mean_light(paths, {{0, 0, 3}, {0, 0, -1}}, 2048);
  }
};

TEST(LightPaths, ABodyInsideAnotherOfItsKindIsNotSeen) {
  StillLife alone;
  alone.has_ground = false;
  alone.add(make_sphere_skin(Vec3::Zero(), 1), kCream);
  const std::vector<SkinShape> shapes = alone.shapes();
  Stage stage = alone.stage();
  stage.looks = {Look::kGelatin};
  stage.mean_free_paths = {0.5};
  LightPaths paths(stage);
  paths.update({&shapes});
  const Vector3f expected = mean_light(paths, {{0, 0, 3}, {0, 0, -1}}, 2048);
  EXPECT_LT((CherryInJelly(kCream).light() - expected).cwiseAbs().maxCoeff(), 0.03F * expected.maxCoeff());
}

TEST(LightPaths, ASmallBodyInsideALargeOneIsSeenInAnyOrder) {
  const Vector3f plain = CherryInJelly(kCream).light();
  const Vector3f last = CherryInJelly(kRed).light();
  const Vector3f first = CherryInJelly(kRed, true).light();
  EXPECT_LT(last.z() / last.x(), 0.8F * plain.z() / plain.x());
  EXPECT_LT((first - last).cwiseAbs().maxCoeff(), 0.03F * last.maxCoeff());
}

TEST(LightPaths, AnOpenSkinLetsNoLightIn) {
  Ball ball(kWhitePaint);
  ball.scene.skins[0].triangles.conservativeResize(ball.scene.skins[0].triangles.rows() - 20, 3);
  Stage stage = ball.scene.stage();
  const auto light = [&] {
    LightPaths paths(stage, StageLight::even({1, 1, 1}), all_of(Finish::of(Look::kGelatin)));
    paths.update({&ball.shapes});
    return mean_light(paths, {{0, 0.2F, 3}, {0, 0, -1}}, 16);
  };
  const Vector3f opaque = light();
  stage.mean_free_paths = {1.0};
  EXPECT_EQ(light(), opaque);
}

/// Two balls that touch lose nothing either, though light goes to and fro between them.
TEST(LightPaths, WhiteBodiesDisappearTogether) {
  StillLife scene;
  scene.has_ground = false;
  scene.add(make_sphere_skin({-1, 0, 0}, 1), kWhitePaint);
  scene.add(make_sphere_skin({1, 0, 0}, 1), kWhitePaint);
  const std::vector<SkinShape> shapes = scene.shapes();
  LightPaths paths(scene.stage(), StageLight::even({1, 1, 1}), all_of(Finish::matt()));
  paths.update({&shapes});
  for (const float x : {0.03F, 0.1F, 0.3F}) {
    EXPECT_NEAR(mean_light(paths, {{x, 0, 3}, {0, 0, -1}}, 1024).x(), 1, 0.02) << x;
  }
}

/// A Lambert ball over no floor has a radiance in closed form: the cosine to the key light, which is small enough to
/// be a point on its lit side, and the mean of the light around weighted by the cosine.
TEST(LightPaths, ALambertBallHasItsRadianceInClosedForm) {
  const Ball ball({0.5F, 0.5F, 0.5F});
  const Stage stage = ball.scene.stage();
  const StageLight light(lighting_of(LightPreset::kStudio), std::nullopt);
  LightPaths paths(stage, light, all_of(Finish::matt()));
  paths.update({&ball.shapes});
  const Vector3f to_key = lighting_of(LightPreset::kStudio).to_key().cast<float>();
  const float color = linear_from_srgb(0.5F);
  const Vector3f key = light.key_radiance() / light.key_density() / std::numbers::pi_v<float>;
  for (const Vector3f& normal : {Vector3f(0.6F, 0.8F, 0), to_key, Vector3f(0.8F, 0, 0.6F), Vector3f(0, -0.8F, 0.6F)}) {
    const TangentFrame frame(normal);
    Vector3f around = Vector3f::Zero();
    constexpr int kSide = 200;
    for (int i = 0; i < kSide * kSide; ++i) {
      around += light.around(frame.to_world(on_cosine_hemisphere(on_grid(i, kSide)))) / (kSide * kSide);
    }
    const Vector3f expected = color * (around + std::max(normal.dot(to_key), 0.0F) * key);
    const Vector3f point = ball.scale() * normal;
    const Vector3f found = mean_light(paths, towards(point, 3 * normal), 2048);
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 0.01F * expected.maxCoeff()) << normal.transpose();
  }
}

TEST(LightPaths, AMirrorShowsWhatLiesThere) {
  const Ball ball(kWhitePaint);
  const StageLight light(lighting_of(LightPreset::kStudio), std::nullopt);
  LightPaths paths(ball.scene.stage(), light, all_of(Finish({.roughness = 0.02F, .is_metal = true})));
  paths.update({&ball.shapes});
  const Vector3f normal = Vector3f(-1, 0.6F, 0.5F).normalized();
  const Vector3f from = 2 * ball.scale() * normal + Vector3f(0.3F, 0.1F, 0.2F);
  const Ray ray = towards(ball.scale() * normal, from);
  const Vector3f mirrored = ray.direction - 2 * ray.direction.dot(normal) * normal;
  const Vector3f found = mean_light(paths, ray, 64);
  EXPECT_LT((found - light.around(mirrored)).norm(), 0.05F * found.norm());
  EXPECT_GT((found - light.around(normal)).norm(), 0.2F * found.norm());
}

/// What a look reflects never exceeds the brightest light on it, even if it is lit from everywhere.
TEST(LightPaths, ColoursOnlyTakeLightAway) {
  for (const Look look : kLooks) {
    const Ball ball({0.9F, 0.5F, 0.2F});
    LightPaths paths(ball.scene.stage(), StageLight::even({1, 1, 1}), all_of(Finish::of(look)));
    paths.update({&ball.shapes});
    const Vector3f light = mean_light(paths, {{0.1F, 0.2F, 3}, {0, 0, -1}}, 256);
    EXPECT_LT(light.maxCoeff(), 1) << int(look);
    EXPECT_GT(light.x(), light.z()) << int(look);
  }
}

TEST(LightPaths, AFloorWithoutBodiesIsWithoutNoise) {
  StillLife scene;
  scene.add(make_sphere_skin({50, 1, 0}, 1), kWhitePaint);
  scene.add(make_sphere_skin({-50, 1, 0}, 1), kWhitePaint);
  const std::vector<SkinShape> shapes = scene.shapes();
  LightPaths paths(scene.stage());
  paths.update({&shapes});
  Sampler sampler(1);
  const PathSample sample = paths.sample({{0, 0.5F, 0}, {0, -1, 0}}, false, sampler);
  EXPECT_EQ(sample.seen, Seen::kFloor);
  EXPECT_EQ(sample.floor_light, Vector3f::Ones());
}

/// Reflections of the key light in a body that the floor sees are few and bright; they are spread.
TEST(LightPaths, NoSampleOfTheFloorGlares) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 1, 0}, 1), kWhitePaint);
  const std::vector<SkinShape> shapes = scene.shapes();
  Stage stage = scene.stage();
  stage.looks = {Look::kSteel};
  LightPaths paths(stage);
  paths.update({&shapes});
  const Ray ray = towards({0.7F, -0.577F, 0}, {0.9F, 0, 0.5F});
  float brightest = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    Sampler sampler(3 * 4096 + i);
    const PathSample sample = paths.sample(ray, false, sampler);
    ASSERT_EQ(sample.seen, Seen::kFloor);
    brightest = std::max(brightest, sample.floor_light.maxCoeff());
  }
  EXPECT_LT(brightest, 5);
}

}  // namespace
}  // namespace sprung
