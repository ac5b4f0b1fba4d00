#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <thread>

#include "core/error.h"
#include "render/gl/context.h"
#include "render/renderer.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

Image drawn_by(const char* gl, const StillLife& scene, const RenderOptions& options) {
  setenv("SPRUNG_GL", gl, 1);
  Image image = draw_scene(scene, options);
  unsetenv("SPRUNG_GL");
  return image;
}

TEST(GlContext, OsmesaAndEglDrawTheSameBits) {
  StillLife scene = ball_on_ground();
  scene.add(make_ring_skin({1.2, 0.2, 0}, 0.4, 0.2), kCream);
  scene.add(make_box_skin({-1.5, 0, -0.5}, {-0.7, 0.6, 0.3}), kRed);
  set_texture(scene.skins.back(), draw_scene(ball_on_ground(), {64, 64, 1}));
  for (const Quality quality : {Quality::kPreview, Quality::kDefault, Quality::kHigh}) {
    RenderOptions options = kSmall;
    options.quality = quality;
    options.samples = samples_of(quality);
    EXPECT_EQ(drawn_by("osmesa", scene, options).pixels, drawn_by("egl", scene, options).pixels) << int(quality);
  }
}

TEST(GlContext, ADrawingMayMoveToAnotherThread) {
  for (const char* gl : {"osmesa", "egl"}) {
    setenv("SPRUNG_GL", gl, 1);
    const StillLife scene = ball_on_ground();
    const Stage stage = scene.stage();
    const Camera camera = frame_bounds(stage.bounds, 16.0 / 9);
    Renderer renderer(stage, kSmall);
    const Image here = renderer.draw(scene.shapes(), camera);
    Image there;
    std::thread([&] { there = renderer.draw(scene.shapes(), camera); }).join();
    EXPECT_EQ(here.pixels, there.pixels) << gl;
  }
  unsetenv("SPRUNG_GL");
}

TEST(GlContext, OtherNamesAreRefused) {
  setenv("SPRUNG_GL", "glx", 1);
  try {
    const GlContext context;
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("'glx' is none of osmesa, egl, gpu"), std::string::npos);
  }
  unsetenv("SPRUNG_GL");
}

}  // namespace
}  // namespace sprung
