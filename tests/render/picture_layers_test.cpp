#include "render/picture_layers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/image/compare.h"
#include "render/trace/ray_scene.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

StillLife two_balls(double distance) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 0.5, 0}, 0.5), kRed);
  scene.add(make_sphere_skin({0, 0.5, distance}, 0.3), kRed);
  scene.has_ground = false;
  return scene;
}

std::vector<SkinShape> with_opacities(const StillLife& scene, const std::vector<float>& opacities) {
  std::vector<SkinShape> shapes = scene.shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    shapes[i].opacities.setConstant(shapes[i].positions.rows(), opacities[i]);
  }
  return shapes;
}

Image drawn(const StillLife& scene, const std::vector<SkinShape>& shapes, const RenderOptions& options = kSmall) {
  const Stage stage = scene.stage();
  return Renderer(stage, options).draw(shapes, frame_bounds(stage.bounds, 16.0 / 9, 0, 0));
}

/// The opacity of the object in the middle of the picture.
double opacity_of(const Image& picture, const Image& nothing, const Image& all) {
  const auto middle = [](const Image& image) { return pixel(image, image.width / 2, image.height / 2).sum(); };
  return (middle(picture) - middle(nothing)) / (middle(all) - middle(nothing));
}

TEST(PictureLayers, AddUpToOneFromTheMostOpaqueOn) {
  const StillLife scene = two_balls(2);
  EXPECT_EQ(picture_layers(false, scene.shapes()).size(), 1U);
  const std::vector<PictureLayer> with_ghosts = picture_layers(true, scene.shapes());
  ASSERT_EQ(with_ghosts.size(), 2U);
  EXPECT_EQ(with_ghosts[1].weight, kGhostOpacity);
  const std::vector<PictureLayer> faint = picture_layers(false, with_opacities(scene, {1, 1}));
  ASSERT_EQ(faint.size(), kOpacities.size());
  double sum = 0;
  for (std::size_t i = 0; i < faint.size(); ++i) {
    EXPECT_EQ(faint[i].min_opacity, float(kOpacities[kOpacities.size() - 1 - i]));
    sum += faint[i].weight;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(PictureLayers, ShowFaintThingsByTheirOpacity) {
  const StillLife scene = two_balls(-3);
  const Image all = drawn(scene, with_opacities(scene, {1, 1}));
  std::vector<SkinShape> away = scene.shapes();
  for (SkinShape& shape : away) shape.positions.col(1).array() += 50;
  const Image nothing = drawn(scene, away);
  for (const double opacity : kOpacities) {
    const Image picture = drawn(scene, with_opacities(scene, {float(opacity), float(opacity)}));
    EXPECT_NEAR(opacity_of(picture, nothing, all), opacity, 0.01) << opacity;
  }
}

// A ball behind another one is hidden by it, as faint as both are: a mean over rays would show some of it.
TEST(PictureLayers, FaintThingsHideNoMoreTogether) {
  const StillLife scene = two_balls(-3);
  std::vector<SkinShape> one = with_opacities(scene, {0.18F, 0.18F});
  one[1].positions.col(1).array() += 50;
  EXPECT_EQ(drawn(scene, with_opacities(scene, {0.18F, 0.18F})).pixels, drawn(scene, one).pixels);
}

TEST(PictureLayers, AreThoseOfTracedPictures) {
  if (!RayScene::is_available()) GTEST_SKIP() << "built without Embree";
  const StillLife scene = two_balls(-3);
  const std::vector<SkinShape> faint = with_opacities(scene, {0.6F, 0.18F});
  const Image raster = drawn(scene, faint, {160, 90, 4});
  const Image traced = drawn(scene, faint, {.width = 160, .height = 90, .samples = 64, .quality = Quality::kFinal});
  EXPECT_LT(compare_images(raster, traced).mean, 5);
}

// Faint objects darken neither the floor nor opaque objects.
TEST(PictureLayers, NothingFaintCastsAShadow) {
  StillLife scene = two_balls(0);
  scene.has_ground = true;
  std::vector<SkinShape> faint = with_opacities(scene, {0.18F, 0.18F});
  const Image picture = drawn(scene, faint);
  for (SkinShape& shape : faint) shape.positions.col(1).array() += 50;
  const Image nothing = drawn(scene, faint);
  const auto darkest = [](const Image& image) { return *std::min_element(image.pixels.begin(), image.pixels.end()); };
  EXPECT_GT(darkest(picture), 0.7 * darkest(nothing));
}

}  // namespace
}  // namespace sprung
