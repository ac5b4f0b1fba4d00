#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/golden.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

const Eigen::Vector3f kBlue(0.23F, 0.49F, 0.65F);
const Eigen::Vector3f kAmber(0.91F, 0.64F, 0.24F);

TEST(RenderGolden, BallOnGround) { expect_golden(draw_scene(ball_on_ground(), kSmall), "render_ball_on_ground"); }

TEST(RenderGolden, BallInTheAir) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 1.1, 0}, 0.5), kBlue);
  Skin low = make_box_skin({-0.4, 0, -0.4}, {0.4, 0.3, 0.4});
  scene.add(refined(low, 0.1), kCream);
  expect_golden(draw_scene(scene, kSmall), "render_ball_in_the_air");
}

TEST(RenderGolden, TexturedBox) {
  Image picture(64, 64);  // checks, darker towards the lower right
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto at = 3 * std::size_t(64 * y + x);
      const bool light = ((x / 8) + (y / 8)) % 2 == 0;
      picture.pixels[at] = static_cast<std::uint8_t>(light ? 230 : 40);
      picture.pixels[at + 1] = static_cast<std::uint8_t>(250 - 3 * x);
      picture.pixels[at + 2] = static_cast<std::uint8_t>(250 - 3 * y);
    }
  }
  StillLife scene;
  Skin box = make_box_skin({-0.6, 0, -0.4}, {0.6, 0.8, 0.4});
  set_texture(box, picture);
  scene.add(box, kCream);
  expect_golden(draw_scene(scene, kSmall), "render_textured_box");
}

TEST(RenderGolden, RingWithVertexColours) {
  StillLife scene;
  Skin ring = make_ring_skin({0, 0.2, 0}, 0.6, 0.2);
  ring.colors.resize(ring.positions.rows(), 4);
  for (int i = 0; i < ring.positions.rows(); ++i) {
    const float a = 6.2831853F * ring.uvs(i, 0);
    ring.colors.row(i) << 0.6F + 0.35F * std::cos(a), 0.5F + 0.3F * std::cos(a + 2.1F),
        0.55F + 0.4F * std::cos(a + 4.2F), 1.0F;
  }
  scene.add(ring, kCream);
  expect_golden(draw_scene(scene, kSmall), "render_ring_with_vertex_colours");
}

TEST(RenderGolden, ManyBodies) {
  StillLife scene;
  const std::array<Eigen::Vector3f, 4> colors{kRed, kAmber, kBlue, kCream};
  for (int i = 0; i < 7; ++i) {
    const double angle = 6.283185307 * i / 7;
    const Vec3 place(0.8 * std::cos(angle), 0, 0.8 * std::sin(angle));
    const Vec3 up(0, 0.2 + (i == 3 ? 0.4 : 0.0), 0);
    scene.add(i % 2 == 0 ? make_sphere_skin(place + up, 0.2)
                         : make_box_skin(place - Vec3(0.18, 0, 0.18), place + Vec3(0.18, 0.36, 0.18)),
              colors[i % 4]);
  }
  scene.add(make_ring_skin({0, 0.12, 0}, 0.3, 0.12), kCream);
  expect_golden(draw_scene(scene, kSmall), "render_many_bodies");
}

}  // namespace
}  // namespace sprung
