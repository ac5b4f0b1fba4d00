#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "render/image/compare.h"
#include "render/renderer.h"
#include "tests/support/golden.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

constexpr RenderOptions kTraced{.width = 160, .height = 90, .samples = 16, .quality = Quality::kFinal};
constexpr RenderOptions kRaster{.width = 160, .height = 90, .samples = 16, .quality = Quality::kHigh};

const Eigen::Vector3f kTeal(0.20F, 0.55F, 0.52F);

/// A ball, a box and a ring that stand close together.
StillLife three_bodies() {
  StillLife scene;
  scene.add(make_sphere_skin({0, 0.5, 0}, 0.5), kRed);
  scene.add(make_box_skin({0.6, 0, -0.4}, {1.2, 0.7, 0.4}), kTeal);
  scene.add(make_ring_skin({-0.8, 0.15, 0.3}, 0.35, 0.15), kCream);
  return scene;
}

double difference(const Image& a, const Image& b) { return compare_images(a, b).mean; }  // levels of 255

int level(const Image& image, int x, int y) { return image.pixels[3 * std::size_t(y * image.width + x) + 1]; }

TEST(TracedPicture, IsTheRastersPictureToTheEye) {
  const StillLife scene = three_bodies();
  EXPECT_LT(difference(draw_scene(scene, kTraced), draw_scene(scene, kRaster)), 4);
}

TEST(TracedPicture, HasTheRastersBackgroundWhereNoBodyIs) {
  const StillLife scene = ball_on_ground();
  const Image traced = draw_scene(scene, kTraced);
  const Image raster = draw_scene(scene, kRaster);
  for (int x = 0; x < traced.width; ++x) {
    EXPECT_NEAR(level(traced, x, 1), level(raster, x, 1), 1) << x;
  }
}

TEST(TracedPicture, TheNumberOfThreadsDoesNotMatter) {
  const StillLife scene = three_bodies();
  const Image many = draw_scene(scene, kTraced);
  for (const std::size_t threads : {1U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(draw_scene(scene, kTraced).pixels, many.pixels) << threads;
  }
}

TEST(TracedPicture, SixteenSamplesAreWithoutVisibleNoise) {
  RenderOptions many = kTraced;
  many.samples = 512;
  const StillLife scene = three_bodies();
  const Image noisy = draw_scene(scene, kTraced);
  const Image true_picture = draw_scene(scene, many);
  double squares = 0;
  for (std::size_t i = 0; i < noisy.pixels.size(); ++i) {
    squares += std::pow(int(noisy.pixels[i]) - int(true_picture.pixels[i]), 2);
  }
  EXPECT_LT(std::sqrt(squares / double(noisy.pixels.size())), 2.5);
}

TEST(TracedPicture, AStillSceneDoesNotFlicker) {
  const StillLife scene = three_bodies();
  const Stage stage = scene.stage();
  Renderer renderer(stage, kTraced);
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  EXPECT_EQ(renderer.draw(scene.shapes(), camera).pixels, renderer.draw(scene.shapes(), camera).pixels);
}

TEST(TracedPicture, ShadowsAreWhereTheRasterHasThem) {
  const Image traced = draw_scene(ball_on_ground(), kTraced);
  const Image raster = draw_scene(ball_on_ground(), kRaster);
  int darkest = 255;
  for (int y = 50; y < 90; ++y) {
    for (int x = 0; x < 160; ++x) {
      if (level(raster, x, y) >= 120) continue;
      darkest = std::min(darkest, level(traced, x, y));
      EXPECT_LT(level(traced, x, y), 190) << x << ' ' << y;
    }
  }
  EXPECT_LT(darkest, 110);
}

TEST(TracedPicture, TexturesAndVertexColoursAreTheRasters) {
  Image picture(8, 8);
  for (int i = 0; i < 64; ++i) {
    const bool is_light = (i / 8 + i) % 2 == 0;
    for (int k = 0; k < 3; ++k) picture.pixels[std::size_t(3 * i + k)] = std::uint8_t(is_light ? 220 : 60 + 60 * k);
  }
  StillLife textured;
  Skin box = make_box_skin({-0.6, 0, -0.4}, {0.6, 0.8, 0.4});
  set_texture(box, picture);
  textured.add(box, kCream);
  EXPECT_LT(difference(draw_scene(textured, kTraced), draw_scene(textured, kRaster)), 4);
  StillLife coloured;
  Skin ball = make_sphere_skin({0, 0.5, 0}, 0.5);
  ball.colors.resize(ball.positions.rows(), 4);
  for (int i = 0; i < ball.positions.rows(); ++i) ball.colors.row(i) << ball.uvs(i, 0), 0.5F, ball.uvs(i, 1), 1.0F;
  coloured.add(ball, kCream);
  EXPECT_LT(difference(draw_scene(coloured, kTraced), draw_scene(coloured, kRaster)), 4);
}

TEST(TracedPicture, AGhostIsFaintAndCastsNoShadow) {
  StillLife scene = three_bodies();
  Stage stage = scene.stage();
  stage.ghosts = {true, false, false};
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  EXPECT_LT(difference(Renderer(stage, kTraced).draw(scene.shapes(), camera),
                       Renderer(stage, kRaster).draw(scene.shapes(), camera)),
            4);
}

TEST(TracedPicture, IsTransparentWhereThereIsNoBody) {
  RenderOptions clear = kTraced;
  clear.transparent = true;
  clear.samples = 64;
  RenderOptions raster = kRaster;
  raster.transparent = true;
  const Image traced = draw_scene(ball_on_ground(), clear);
  const Image other = draw_scene(ball_on_ground(), raster);
  ASSERT_EQ(traced.alpha.size(), other.alpha.size());
  for (std::size_t i = 0; i < traced.alpha.size(); ++i) EXPECT_NEAR(traced.alpha[i], other.alpha[i], 40) << i;
  EXPECT_EQ(traced.alpha.front(), 0);
}

/// The ball moves by its radius while the shutter is open.
TEST(TracedPicture, MotionAndLensBlurAsTheRasters) {
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  const std::vector<SkinShape> first = scene.shapes();
  std::vector<SkinShape> last = first;
  last[0].positions.col(0).array() += 0.5F;
  Camera camera = frame_bounds(stage.bounds, 16.0 / 9, 0);
  RenderOptions raster = kRaster;
  raster.exposes = true;
  RenderOptions traced = kTraced;
  traced.exposes = true;
  EXPECT_LT(difference(Renderer(stage, traced).draw({{first, last, camera}}),
                       Renderer(stage, raster).draw({{first, last, camera}})),
            5);
  camera.target.z() -= 3;
  camera.aperture = 0.3;
  const Image sharp = Renderer(stage, kTraced).draw(first, [&] {
    Camera pinhole = camera;
    pinhole.aperture = 0;
    return pinhole;
  }());
  const Image soft = Renderer(stage, traced).draw({{first, first, camera}});
  EXPECT_LT(difference(soft, Renderer(stage, raster).draw({{first, first, camera}})), 4);
  EXPECT_GT(difference(soft, sharp), 2);
}

TEST(TracedPicture, ItsPassesHaveItsLight) {
  const StillLife scene = ball_on_ground();
  const Stage stage = scene.stage();
  Renderer renderer(stage, kTraced);
  const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
  const std::vector<SkinShape> shapes = scene.shapes();
  const Moment now{shapes, camera};
  const Passes alone = renderer.draw_passes(now, now, now);
  static_cast<void>(renderer.draw(shapes, camera));
  const Passes beside = renderer.draw_passes(now, now, now);
  EXPECT_EQ(alone.beauty, beside.beauty);
  EXPECT_GT(*std::max_element(alone.beauty[0].begin(), alone.beauty[0].end()), 0.5F);
}

TEST(TracedPicture, RefusesNumbersOfSamplesThatItCannotTake) {
  RenderOptions none = kTraced;
  none.samples = 0;
  EXPECT_THROW(draw_scene(ball_on_ground(), none), Error);
  none.samples = 5000;
  EXPECT_THROW(draw_scene(ball_on_ground(), none), Error);
  none.samples = 7;
  EXPECT_NO_THROW(draw_scene(ball_on_ground(), none));
}

TEST(TracedGolden, ThreeBodies) {
  expect_golden(draw_scene(three_bodies(), {.width = 64, .height = 64, .samples = 64, .quality = Quality::kFinal}),
                "traced_three_bodies");
}

}  // namespace
}  // namespace sprung
