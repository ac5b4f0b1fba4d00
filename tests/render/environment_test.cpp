#include "render/stage/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <optional>

#include "core/io/decode_image.h"
#include "render/image/png.h"
#include "render/stage/panorama.h"
#include "tests/support/error_message.h"
#include "tests/support/golden.h"
#include "tests/support/still_life.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

using Light = Eigen::Vector3f;

/// `light_of` a unit vector.
template <class LightOf>
Panorama panorama(int height, const LightOf& light_of) {
  Panorama all{2 * height, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) {
      const double around = 2 * std::numbers::pi * ((x + 0.5) / (2 * height) - 0.5);
      const double down = std::numbers::pi * (y + 0.5) / height;
      const Eigen::Vector3d to(std::sin(down) * std::sin(around), std::cos(down), -std::sin(down) * std::cos(around));
      all.light.push_back(light_of(to.cast<float>().eval()));
    }
  }
  return all;
}

/// Evening: a low sun and a glow around it, at the camera's left and behind it; blue above.
Light evening(const Light& to) {
  const float near_sun = to.dot(Light(-0.75F, 0.28F, 0.6F).normalized());
  const Light glow = Light(1.0F, 0.42F, 0.12F) * (std::exp(9 * (near_sun - 1)) + 30 * std::exp(300 * (near_sun - 1)));
  return glow + Light(0.10F, 0.19F, 0.42F) * (0.4F + std::max(to.y(), 0.0F));
}

float brightness(const Light& light) { return Light(0.2126F, 0.7152F, 0.0722F).dot(light); }

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

// Closed form: half of an even sky is seen from a wall, all of it from the ground.
TEST(Environment, AnEvenSkyLightsBySlope) {
  for (const int height : {1, 3, 64, 200}) {
    const Environment sky(panorama(height, [](const Light&) { return Light(5, 5, 5); }));
    const float whole = sky.irradiance_on(Light::UnitY()).y();
    EXPECT_NEAR(whole, brightness(lighting_of(LightPreset::kStudio).sky), 1e-5) << height;
    for (const double slope : {0.0, 30.0, 90.0, 140.0, 180.0}) {
      const double angle = slope * std::numbers::pi / 180;
      const Light to = Eigen::Vector3d(std::sin(angle), std::cos(angle), 0).cast<float>();
      EXPECT_NEAR(sky.irradiance_on(to).x(), whole * (1 + std::cos(angle)) / 2, 2e-3 * whole) << height << " " << slope;
    }
    for (const Panorama& level : sky.reflections) EXPECT_NEAR(level.light.front().x(), whole, 1e-3 * whole);
  }
}

/// The light from above that a steel ball reflects back up: weighted by the cosine of its direction, as for level
/// ground.
double reflected_sky(const std::optional<Environment>& environment) {
  StillLife scene = ball_on_ground();
  scene.colors = {{0.9F, 0.9F, 0.9F}};
  Stage stage = scene.stage();
  stage.looks = {Look::kSteel};
  stage.environment = environment;
  Renderer renderer(stage, {.width = 180, .height = 180, .samples = 4, .transparent = true});
  const Image image = renderer.draw(scene.shapes(), frame_bounds(stage.bounds, 1, 0, 89));
  const auto area = double(std::count(image.alpha.begin(), image.alpha.end(), 255));
  double light = 0;
  double weights = 0;
  for (int i = 0; i < 180 * 180; ++i) {
    const double x = i % 180 - 89.5;
    const double y = i / 180 - 89.5;
    const double height = 1 - 2 * std::numbers::pi * (x * x + y * y) / area;  // cosine of twice the normal's angle
    if (height <= 0) continue;
    light += height * std::pow(image.pixels[3 * std::size_t(i) + 1] / 255.0, 2.2);
    weights += height;
  }
  return light / weights;
}

TEST(Environment, TheStudioReflectsAsMuchLightAsItsSkyGives) {
  const Environment even(panorama(16, [](const Light&) { return lighting_of(LightPreset::kStudio).sky; }));
  EXPECT_NEAR(reflected_sky(std::nullopt) / reflected_sky(even), 1, 0.12);
}

TEST(Environment, KeepsDirectionsAndColours) {
  const Environment sky(panorama(64, [](const Light& to) {
    return to.dot(Light(0.9F, 0.3F, 0.3F).normalized()) > 0.97F ? Light(9, 2, 1) : Light(0.1F, 0.1F, 0.1F);
  }));
  EXPECT_GT(sky.irradiance_on(Light::UnitX()).x(), 3 * sky.irradiance_on(-Light::UnitX()).x());
  EXPECT_GT(sky.irradiance_on(Light::UnitX()).x(), 2 * sky.irradiance_on(Light::UnitX()).z());
  EXPECT_GT(sky.irradiance_on(Light::UnitZ()).x(), sky.irradiance_on(-Light::UnitZ()).x());
  float before = 1e9F;
  for (const Panorama& level : sky.reflections) {
    const auto brightest = std::max_element(level.light.begin(), level.light.end(),
                                            [](const Light& a, const Light& b) { return a.x() < b.x(); });
    const auto at = int(brightest - level.light.begin());
    EXPECT_NEAR((at % level.width + 0.5) / level.width, 0.75 + 18.4 / 360, 0.04);  // a little behind +x
    EXPECT_LT(brightest->x(), before);                                             // the rougher, the smoother
    before = brightest->x();
  }
}

TEST(Environment, DoesNotDependOnThePanoramasBrightness) {
  const Environment one(panorama(32, evening));
  const Environment other(panorama(32, [](const Light& to) { return (1000 * evening(to)).eval(); }));
  for (std::size_t k = 0; k < one.irradiance.size(); ++k) {
    EXPECT_LT((one.irradiance[k] - other.irradiance[k]).norm(), 1e-5) << k;
  }
}

/// An even sky with a disc of light: three quarters of the light on what faces it.
struct SunnySky {
  Light to_sun = Light(0.6F, 0.5F, -0.4F).normalized();
  double radius = 2.5 * std::numbers::pi / 180;  // angle

  [[nodiscard]] Panorama panorama() const {
    const auto disc = float(std::numbers::pi * 3 / (std::numbers::pi * std::sin(radius) * std::sin(radius)));
    return sprung::panorama(512, [&](const Light& to) {
      return to.dot(to_sun) > float(std::cos(radius)) ? Light(1 + disc, 1 + 0.8F * disc, 1 + 0.5F * disc)
                                                      : Light(1, 1, 1);
    });
  }
};

TEST(Environment, FindsTheSun) {
  const SunnySky sky;
  const Environment with(sky.panorama(), {.has_sun = true});
  ASSERT_TRUE(with.sun);
  EXPECT_GT(with.sun->direction.dot(sky.to_sun), std::cos(0.1 * std::numbers::pi / 180));
  EXPECT_NEAR(with.sun->radius, std::sin(sky.radius), 0.02 * sky.radius);
  // Irradiances over pi: 3 of the sun, and of an even sky 1.
  const float level = with.irradiance_on(Light::UnitY()).x();
  EXPECT_NEAR(with.sun->irradiance.x() / level, 3, 0.1);
  EXPECT_NEAR(with.sun->irradiance.y() / level, 3 * 0.8, 0.1);
  EXPECT_NEAR(with.irradiance_on(sky.to_sun).x() / level, 0.5 + 0.5 * sky.to_sun.y(), 0.01);
  // What faces it is as bright as what faces the studio's key light.
  const Lighting studio = lighting_of(LightPreset::kStudio);
  EXPECT_NEAR(brightness(with.sun->irradiance + with.irradiance_on(sky.to_sun)),
              brightness(studio.key + float(0.5 + 0.5 * studio.to_key().y()) * studio.sky), 0.01);
  const Lighting lit = lit_by(*with.sun, studio);
  EXPECT_LT((lit.to_key().cast<float>() - sky.to_sun).norm(), 0.002);

  EXPECT_FALSE(Environment(sky.panorama()).sun);
  EXPECT_FALSE(Environment(panorama(64, [](const Light&) { return Light(1, 1, 1); }), {.has_sun = true}).sun);
  const auto window = [](const Light& to) {
    return to.dot(Light(0, 0.6F, 0.8F)) > 0.8F ? Light(6, 6, 6) : Light(1, 1, 1);
  };
  EXPECT_FALSE(Environment(panorama(64, window), {.has_sun = true}).sun);
}

TEST(Environment, TurnsAsAzimuthsGrow) {
  const SunnySky sky;
  for (const double turn : {0.0, 90.0, -30.0, 400.0}) {
    const Environment turned(sky.panorama(), {.turn = turn, .has_sun = true, .is_seen = true});
    const Lighting lit = lit_by(*turned.sun, lighting_of(LightPreset::kStudio));
    const double azimuth = std::atan2(sky.to_sun.x(), sky.to_sun.z()) * 180 / std::numbers::pi;
    EXPECT_NEAR(std::remainder(lit.azimuth - azimuth - turn, 360), 0, 0.1) << turn;
    EXPECT_GT(looked_up(*turned.background, lit.to_key().cast<float>()).x(), 100) << turn;
  }
}

TEST(Environment, TheBackgroundIsAtMost4096TexelsWide) {
  const Environment wide(panorama(2080, [](const Light& to) { return Light(2 + to.x(), 2, 2); }), {.is_seen = true});
  EXPECT_EQ(wide.background->width, 2080);
  EXPECT_EQ(wide.background->height, 1040);
  EXPECT_NEAR(looked_up(*wide.background, Light(1, 0, 0)).x(), 3, 1e-3);
}

TEST(Environment, RefusesWhatGivesNoLight) {
  const auto below = [](const Light& to) { return (to.y() < 0 ? Light(1, 1, 1) : Light(0, 0, 0)); };
  EXPECT_EQ(error_message([&] { Environment{panorama(16, below)}; }),
            "the surroundings are black above the horizon: no light");
  Panorama square{2, 2, std::vector<Light>(4, Light(1, 1, 1))};
  EXPECT_EQ(error_message([&] { Environment{square}; }),
            "the surroundings must be twice as wide as high: all around, from zenith to nadir");
}

TEST(DecodePanorama, ReadsRadianceAndPng) {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  const Panorama bright = decode_panorama(bytes_of(head + std::string("\x80\x40\x20\x8a\x80\x80\x80\x81", 8)), "a.hdr");
  EXPECT_EQ(bright.width, 2);
  EXPECT_EQ(bright.height, 1);
  EXPECT_EQ(bright.light.at(0), Light(512, 256, 128));  // mantissa * 2^(exponent - 136)
  EXPECT_EQ(bright.light.at(1), Light(1, 1, 1));

  Image image(2, 1);
  image.pixels = {255, 0, 128, 128, 128, 128};
  const TempFolder folder;
  write_png(image, folder.path() / "a.png");
  std::ifstream in(folder.path() / "a.png", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const Panorama flat = decode_panorama(bytes_of(bytes), "a.png");
  EXPECT_NEAR(flat.light.at(0).x(), 1, 1e-6);
  EXPECT_EQ(flat.light.at(0).y(), 0);
  EXPECT_NEAR(flat.light.at(1).x(), 0.2195, 1e-3);
  EXPECT_NE(error_message([&] { (void)decode_panorama(bytes_of("no picture"), "b.hdr"); }).find("b.hdr"),
            std::string::npos);
}

constexpr RenderOptions kSmallest{160, 90, 4};

struct Balls {
  StillLife scene;
  Balls() {
    scene.add(make_sphere_skin({-0.65, 0.5, 0}, 0.5), {0.9F, 0.88F, 0.85F});
    scene.add(make_sphere_skin({0.65, 0.5, 0}, 0.5), {0.8F, 0.8F, 0.82F});
  }
  [[nodiscard]] Image picture(const std::optional<Environment>& environment, const Floor& floor = {},
                              const RenderOptions& options = kSmall) const {
    Stage stage = scene.stage();
    stage.looks = {Look::kPlastic, Look::kSteel};
    stage.environment = environment;
    stage.floor = floor;
    if (environment && environment->sun) stage.lighting = lit_by(*environment->sun, stage.lighting);
    Renderer renderer(stage, options);
    return renderer.draw(scene.shapes(), frame_bounds(stage.bounds, 16.0 / 9, 0));
  }
};

TEST(Renderer, SurroundingsColourBodiesAndFloor) {
  const Balls balls;
  const Image studio = balls.picture(std::nullopt);
  const Image green = balls.picture(Environment(panorama(16, [](const Light&) { return Light(0.1F, 1, 0.1F); })));
  const auto greenness = [](const Image& image, int x, int y) {
    const auto at = 3 * std::size_t(y * image.width + x);
    return image.pixels[at + 1] - std::max(image.pixels[at], image.pixels[at + 2]);
  };
  for (const auto& [x, y] : {std::pair{110, 60}, {210, 60}, {10, 170}}) {  // plastic, steel, floor
    EXPECT_LT(greenness(studio, x, y), 8) << x;
    EXPECT_GT(greenness(green, x, y), 20) << x;
  }
}

TEST(RenderGolden, Surroundings) {
  expect_golden(Balls().picture(Environment(panorama(128, evening))), "render_surroundings");
}

/// Hills at the horizon, a sun at the left in front.
Light landscape(const Light& to) {
  if (to.dot(Light(-0.6F, 0.55F, 0.45F).normalized()) > 0.9995F) return {1200, 1050, 800};
  if (to.y() > 0.08F + 0.05F * std::sin(9 * to.x())) return Light(0.45F, 0.65F, 1.0F) * (1.2F - to.y());
  return to.y() > 0 ? Light(0.10F, 0.20F, 0.07F) : Light(0.26F, 0.22F, 0.12F);
}

Environment seen_landscape() { return Environment(panorama(256, landscape), {.has_sun = true, .is_seen = true}); }

TEST(RenderGolden, PanoramaBehindACheckerFloor) {
  expect_golden(Balls().picture(seen_landscape(), floor_of(FloorKind::kChecker, 0.5)), "render_panorama");
}

TEST(RenderGolden, WoodenFloor) {
  expect_golden(Balls().picture(std::nullopt, floor_of(FloorKind::kWood, 0.4)), "render_wood");
}

// Shaders and the path tracer take floor and background from the same values, but have separate code. At the left edge,
// where bodies do not change the light; a mean over some pixels, since edges of squares have few paths.
TEST(Renderer, FloorsAndBackgroundsAreTheSameInAllQualities) {
  const Environment landscape = seen_landscape();
  const std::array<std::pair<FloorKind, bool>, 4> cases{
      {{FloorKind::kSweep, true}, {FloorKind::kPlain, false}, {FloorKind::kChecker, true}, {FloorKind::kWood, false}}};
  for (const auto& [kind, has_panorama] : cases) {
    const std::optional<Environment> environment = has_panorama ? std::optional(landscape) : std::nullopt;
    const Floor floor = floor_of(kind, 0.4);
    const Image drawn = Balls().picture(environment, floor, kSmallest);
    const Image traced = Balls().picture(environment, floor, {160, 90, 16, false, Quality::kFinal});
    for (const int top : {1, 20, 40}) {
      Eigen::Vector3d difference = Eigen::Vector3d::Zero();
      for (int y = top; y < top + 8; ++y) {
        for (int x = 0; x < 8; ++x) difference += (pixel(drawn, x, y) - pixel(traced, x, y)) / 64;
      }
      EXPECT_LT(difference.cwiseAbs().maxCoeff(), 2) << int(kind) << " at " << top;
    }
  }
}

}  // namespace
}  // namespace sprung
