#include "render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <span>
#include <string>

#include "core/error.h"
#include "core/files.h"
#include "tests/support/golden.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

double psnr(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(double(a.pixels[i]) - double(b.pixels[i]), 2);
  return sum == 0 ? 1e9 : 10 * std::log10(255.0 * 255.0 * double(a.pixels.size()) / sum);
}

std::uint64_t hash(const Image& image) { return hash_of(std::as_bytes(std::span(image.pixels))); }

/// Two rows: the upper half of the first colour.
Image two_halves(std::array<std::uint8_t, 3> upper, std::array<std::uint8_t, 3> lower) {
  Image image(16, 16);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = i < image.pixels.size() / 2 ? upper[i % 3] : lower[i % 3];
  }
  return image;
}

TEST(Renderer, SameInputGivesTheSameBytes) {
  const Image first = draw_scene(ball_on_ground(), kSmall);
  EXPECT_EQ(first.pixels, draw_scene(ball_on_ground(), kSmall).pixels);

  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  Renderer renderer(stage, kSmall);
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  (void)renderer.draw(scene.shapes(), frame_bounds(stage.bounds, 16.0 / 9, 120));  // leaves no trace
  EXPECT_EQ(first.pixels, renderer.draw(scene.shapes(), camera).pixels);
}

// Every bit of consecutive pictures of a scene at rest, after some that moved.
TEST(Renderer, AStillSceneDoesNotFlicker) {
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  Renderer renderer(stage, kSmall);
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  std::vector<SkinShape> shapes = scene.shapes();
  const Image moving = renderer.draw(shapes, camera);
  shapes[0].positions.col(1).array() += 0.1F;
  const Image first = renderer.draw(shapes, camera);
  EXPECT_NE(first.pixels, moving.pixels);
  for (int frame = 1; frame < 4; ++frame) {
    EXPECT_EQ(compare_images(first, renderer.draw(shapes, camera)).mean, 0) << frame;
  }
}

TEST(Renderer, MeasuresItsPassesOnRequest) {
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  Renderer silent(stage, kSmall);
  const Image picture = silent.draw(scene.shapes(), camera);
  EXPECT_TRUE(silent.draw_times().empty());
  Renderer measured(stage, {.width = 320, .height = 180, .samples = 4, .measure_passes = true});
  EXPECT_EQ(measured.draw(scene.shapes(), camera).pixels, picture.pixels);
  EXPECT_GT(measured.draw_times().size(), 5U);
  for (const DrawTime& time : measured.draw_times()) EXPECT_GT(time.wall, 0) << time.pass;
}

TEST(RendererChild, DISABLED_PrintsTheHash) { std::printf("hash=%lx\n", hash(draw_scene(ball_on_ground(), kSmall))); }

// llvmpipe reads the number of threads once a process, so each number needs its own.
TEST(Renderer, TheNumberOfThreadsDoesNotMatter) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::array<char, 64> expected{};
  std::snprintf(expected.data(), expected.size(), "hash=%lx", hash(draw_scene(ball_on_ground(), kSmall)));
  for (const char* threads : {"0", "1", "2", "8"}) {
    const std::string command = std::string("LP_NUM_THREADS=") + threads + " '" + program +
                                "' --gtest_also_run_disabled_tests --gtest_filter=RendererChild.* | grep -q " +
                                expected.data();
    EXPECT_EQ(std::system(command.c_str()), 0) << threads << " threads";
  }
}

TEST(Renderer, HostileSettingsAreIgnored) {
  setenv("GALLIUM_DRIVER", "no-such-driver", 1);
  setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1);
  setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  EXPECT_NE(Renderer(stage, kSmall).driver().find("OpenGL"), std::string::npos);
}

// Every bias is a part of the scene's size; what is left is single precision at other numbers.
TEST(Renderer, ThePictureDoesNotDependOnTheScale) {
  const Image one = draw_scene(ball_on_ground(), kSmall);
  for (const double scale : {1e-3, 1e3}) {
    EXPECT_GT(psnr(one, draw_scene(ball_on_ground().scaled(scale), kSmall)), 50) << scale;
  }
}

// The key light comes from the left of the default camera.
TEST(Renderer, TheLitSideIsLighterThanTheOther) {
  const Image image = draw_scene(ball_on_ground(), kSmall);
  const Eigen::Vector3d lit = pixel(image, 145, 60);
  const Eigen::Vector3d dark = pixel(image, 195, 105);
  EXPECT_GT(lit.x(), 1.25 * dark.x());
  EXPECT_GT(lit.x(), 2 * lit.y());  // red stays red
  EXPECT_GT(dark.x(), 2 * dark.y());
  EXPECT_GT(dark.x(), 90);  // and is not black: the sky and the ground light it
}

/// A small picture of a ball in that light, without a lens.
Image lit_ball(const Lighting& lighting, Quality quality) {
  const StillLife scene = ball_on_ground();
  Stage stage = scene.stage();
  stage.lighting = lighting;
  Renderer renderer(stage, {.width = 160, .height = 90, .samples = samples_of(quality), .quality = quality});
  return renderer.draw(scene.shapes(), frame_bounds(stage.bounds, 16.0 / 9));
}

// Shaders and the path tracer take their light from the same values, but have separate code.
TEST(Renderer, EveryPresetOfLightIsTheSameInAllQualities) {
  for (const LightPreset preset : {LightPreset::kStudio, LightPreset::kSoftbox, LightPreset::kSunset,
                                   LightPreset::kOvercast, LightPreset::kNight}) {
    const Image drawn = lit_ball(lighting_of(preset), Quality::kDefault);
    const Image traced = lit_ball(lighting_of(preset), Quality::kFinal);
    for (const int y : {5, 55}) {  // background, and floor that no body lights
      const Eigen::Vector3d difference = pixel(drawn, 5, y) - pixel(traced, 5, y);
      EXPECT_LE(difference.cwiseAbs().maxCoeff(), 2) << int(preset) << " at " << y;
    }
    const Eigen::Vector3d on_ball = pixel(drawn, 72, 40) - pixel(traced, 72, 40);
    EXPECT_LE(on_ball.cwiseAbs().maxCoeff(), 16) << int(preset);
  }
}

TEST(Renderer, TheKeyLightMaySitAnywhere) {
  Lighting lighting = lighting_of(LightPreset::kStudio);
  const Image from_left = lit_ball(lighting, Quality::kDefault);
  lighting.azimuth = 88;  // as far on the other side of the camera's azimuth of 30
  const Image from_right = lit_ball(lighting, Quality::kDefault);
  for (const int x : {60, 70, 90, 100}) {
    EXPECT_NEAR(pixel(from_left, x, 45).x(), pixel(from_right, 159 - x, 45).x(), 18)
        << x;  // the window keeps its position
  }
  EXPECT_GT(pixel(from_left, 65, 45).x(), pixel(from_left, 95, 45).x() + 20);
}

TEST(Renderer, TheBodyCastsItsShadowOnTheGround) {
  const Image with = draw_scene(ball_on_ground(), kSmall);
  StillLife scene = ball_on_ground();
  scene.has_ground = false;
  const Image without = draw_scene(scene, kSmall);
  const double shadow = pixel(with, 240, 121).sum() / pixel(without, 240, 121).sum();
  const double open = pixel(with, 40, 121).sum() / pixel(without, 40, 121).sum();
  EXPECT_LT(shadow, 0.75);
  EXPECT_NEAR(open, 1, 0.01);  // the floor far from the body is the background
}

// The shadow ends as far from its caster as the whole stack is high, not one of its bodies.
TEST(Renderer, TheShadowOfAStackFadesOut) {
  StillLife scene;
  for (int i = 0; i < 6; ++i) scene.add(make_box_skin({-0.2, 0.25 * i, -0.2}, {0.2, 0.25 * (i + 1), 0.2}), kCream);
  const Image image = draw_scene(scene, kSmall, 30, 30);
  double deepest = 255;
  double steepest = 0;  // of a pixel and its neighbours, in levels
  for (int y = 1; y < image.height; ++y) {
    for (int x = 220; x < image.width; ++x) {
      const double here = pixel(image, x, y).mean();
      deepest = std::min(deepest, here);
      steepest = std::max(steepest, std::abs(here - pixel(image, x - 1, y).mean()));
      steepest = std::max(steepest, std::abs(here - pixel(image, x, y - 1).mean()));
    }
  }
  EXPECT_LT(deepest, 190);
  EXPECT_LT(steepest, 12);
}

TEST(Renderer, TheBackgroundIsNeutralAndSmooth) {
  const Image image = draw_scene(ball_on_ground(), kSmall);
  for (int y = 0; y < image.height; ++y) {
    const Eigen::Vector3d color = pixel(image, 3, y);
    EXPECT_LT(color.maxCoeff() - color.minCoeff(), 24) << y;
    EXPECT_GT(color.minCoeff(), 150) << y;
    EXPECT_LT((color - pixel(image, 3, std::max(y - 1, 0))).cwiseAbs().maxCoeff(), 5) << y;
  }
}

constexpr RenderOptions kExposed{.width = 320, .height = 180, .samples = 4, .exposes = true};

std::vector<SkinShape> moved(std::vector<SkinShape> shapes, const Eigen::RowVector3f& way) {
  for (SkinShape& shape : shapes) shape.positions.rowwise() += way;
  return shapes;
}

TEST(Renderer, AnExposureAtRestIsThePicture) {
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  const std::vector<SkinShape> shapes = scene.shapes();
  const std::vector<SkinShape> same = shapes;
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9, 30, 14);
  const Image image = Renderer(stage, kExposed).draw({{shapes, shapes, camera}, {shapes, same, camera}});
  EXPECT_GT(psnr(draw_scene(scene, kSmall), image), 40);  // but at edges, which are mixed in linear light, too
}

// A red ball that is there for half of the time mixes its light with that of the background, not their bytes.
TEST(Renderer, ExposuresAddUpLight) {
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  const std::vector<SkinShape> here = scene.shapes();
  const std::vector<SkinShape> away = moved(here, {0, 0, 50});
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  Renderer renderer(stage, kExposed);
  const auto green = [&](const std::vector<Exposure>& exposures) {
    return pixel(renderer.draw(exposures), 160, 80).y() / 255;
  };
  const double with = green({{here, here, camera}});
  const double without = green({{away, away, camera}});
  const double both = green({{here, here, camera}, {away, away, camera}});
  EXPECT_LT(with, 0.3);
  EXPECT_NEAR(std::pow(both, 2.2), 0.5 * (std::pow(with, 2.2) + std::pow(without, 2.2)), 0.02);
}

TEST(Renderer, MotionBlurShowsNoCopies) {
  StillLife scene;
  scene.add(make_sphere_skin({-0.9, 0.5, 0}, 0.15), kRed);
  Stage stage = scene.stage();
  stage.bounds = AlignedBox(Vec3(-1.1, 0, -0.1), Vec3(1.1, 1, 0.1));
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9, 0);
  std::vector<std::vector<SkinShape>> times;
  for (int i = 0; i <= 8; ++i) times.push_back(moved(scene.shapes(), {0.225F * float(i), 0, 0}));
  std::vector<Exposure> exposures;
  for (std::size_t i = 0; i < 8; ++i) exposures.push_back({times[i], times[i + 1], camera});
  const Image image = Renderer(stage, kExposed).draw(exposures);
  double darkest = 255;
  double steepest = 0;
  for (int x = 100; x < 220; ++x) {
    darkest = std::min(darkest, pixel(image, x, 90).y());
    steepest = std::max(steepest, std::abs(pixel(image, x, 90).y() - pixel(image, x - 1, 90).y()));
  }
  EXPECT_LT(darkest, pixel(image, 160, 50).y() - 5);  // the ball was there
  EXPECT_LT(steepest, 7);
}

// Closed form: the circle of confusion of an edge, from similar triangles through the lens.
TEST(Renderer, ALensBlursByTheDistanceFromItsFocus) {
  StillLife scene;
  scene.add(make_box_skin({-1, 0, -0.2}, {0, 2, 0}), kRed);
  const Stage stage = scene.stage();
  const std::vector<SkinShape> shapes = scene.shapes();
  Renderer renderer(stage, kExposed);
  constexpr double kAway = 4;
  for (const double focus : {2.0, 4.0, 8.0}) {
    const Camera camera{.eye = {0, 1, kAway}, .target = {0, 1, kAway - focus}, .aperture = 0.12};
    const Image image = renderer.draw({{shapes, shapes, camera}});
    const double left = pixel(image, 100, 90).y();
    const double right = pixel(image, 220, 90).y();
    int width = 0;
    for (int x = 100; x < 220; ++x) {
      const double part = (pixel(image, x, 90).y() - left) / (right - left);
      if (part > 0.04 && part < 0.96) ++width;
    }
    const double height_of_picture = 2 * kAway * std::tan(15 * std::numbers::pi / 180);  // at the edge, m
    EXPECT_NEAR(width, 180 * 0.12 * std::abs(kAway - focus) / focus / height_of_picture, 2.1) << focus;
  }
}

TEST(Renderer, TextureRowsRunFromTheTop) {
  StillLife scene;
  Skin box = make_box_skin({-0.5, 0, -0.5}, {0.5, 1, 0.5});
  set_texture(box, two_halves({220, 30, 30}, {30, 30, 220}));
  scene.add(box, kCream);
  const Image image = draw_scene(scene, kSmall, 0);
  const Eigen::Vector3d upper = pixel(image, 160, 75);
  const Eigen::Vector3d lower = pixel(image, 160, 135);
  EXPECT_GT(upper.x(), 2 * upper.z());
  EXPECT_GT(lower.z(), 2 * lower.x());
}

TEST(Renderer, VertexColoursAreInterpolated) {
  StillLife scene;
  Skin box = make_box_skin({-0.5, 0, -0.5}, {0.5, 1, 0.5});
  box.colors.resize(24, 4);
  for (int i = 0; i < 24; ++i) {
    const bool right = box.positions(i, 0) > 0;
    box.colors.row(i) << (right ? 0.1F : 0.9F), 0.1F, (right ? 0.9F : 0.1F), 1.0F;
  }
  scene.add(box, kCream);
  const Image image = draw_scene(scene, kSmall, 0);
  EXPECT_GT(pixel(image, 115, 100).x(), 1.5 * pixel(image, 115, 100).z());
  EXPECT_GT(pixel(image, 205, 100).z(), 1.5 * pixel(image, 205, 100).x());
  const Eigen::Vector3d middle = pixel(image, 160, 100);
  EXPECT_LT(std::abs(middle.x() - middle.z()), 0.25 * middle.maxCoeff());
}

TEST(Renderer, PartsHaveTheirMaterials) {
  StillLife scene;
  Skin box = make_box_skin({-0.5, 0, -0.5}, {0.5, 1, 0.5});
  SurfaceMaterial green;
  green.color = {0.1F, 0.7F, 0.1F, 1.0F};
  box.materials = {green};
  box.parts = {{"sides", 0, 8, 0}, {"rest", 8, 4, -1}};
  scene.add(box, kRed);
  const Image image = draw_scene(scene, kSmall, 0, 50);
  EXPECT_GT(pixel(image, 160, 130).y(), 1.5 * pixel(image, 160, 130).x());
  EXPECT_GT(pixel(image, 160, 60).x(), 1.5 * pixel(image, 160, 60).y());  // the top
}

TEST(Renderer, BackFacesAreLitLikeFrontFaces) {
  StillLife scene = ball_on_ground();
  const Image outside = draw_scene(scene, kSmall);
  Skin& skin = scene.skins[0];
  skin.triangles.col(1).swap(skin.triangles.col(2));
  skin.normals *= -1;
  EXPECT_GT(psnr(outside, draw_scene(scene, kSmall)), 40);
}

TEST(Renderer, WithOneSampleAPixelOnlyEdgesChange) {
  const Image smooth = draw_scene(ball_on_ground(), kSmall);
  const Image rough = draw_scene(ball_on_ground(), {320, 180, 1});
  EXPECT_GT(psnr(smooth, rough), 33);
  EXPECT_NE(smooth.pixels, rough.pixels);
}

// The three draw the same scene; they differ in how fine edges and shadows are.
TEST(Renderer, QualitiesAreFinenessesOfOnePicture) {
  const Image fine =
      draw_scene(ball_on_ground(), {.width = 320, .height = 180, .samples = 16, .quality = Quality::kHigh});
  const Image usual = draw_scene(ball_on_ground(), kSmall);
  const Image rough =
      draw_scene(ball_on_ground(), {.width = 320, .height = 180, .samples = 1, .quality = Quality::kPreview});
  EXPECT_GT(psnr(fine, usual), 38);
  EXPECT_GT(psnr(fine, rough), 31);
  EXPECT_GT(psnr(fine, usual), psnr(fine, rough));
}

TEST(Renderer, RefusesWhatItCannotDraw) {
  const StillLife scene = ball_on_ground();
  EXPECT_THROW(Renderer(scene.stage(), RenderOptions{0, 180, 4}), Error);
  EXPECT_THROW(Renderer(scene.stage(), RenderOptions{320, 20000, 4}), Error);
  EXPECT_THROW(Renderer(scene.stage(), RenderOptions{10000, 180, 4}), Error);  // but not with one sample a pixel
  EXPECT_THROW(Renderer(scene.stage(), RenderOptions{320, 180, 3}), Error);
  StillLife broken = ball_on_ground();
  broken.skins[0].materials = {SurfaceMaterial{}};
  broken.skins[0].materials[0].texture.resize(10);
  broken.skins[0].parts = {{"all", 0, 12, 0}};
  EXPECT_THROW(draw_scene(broken, kSmall), Error);
}

}  // namespace
}  // namespace sprung
