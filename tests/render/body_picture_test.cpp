#include "render/body_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/bodies.h"

namespace sprung {
namespace {

TEST(BodyPicture, ShowsTheBodyOnWhite) {
  Body body = make_body(make_box_grid({4, 2, 2}, 0.05), Model::kCalibrated, test::test_material(0.3));
  for (int i = 0; i < body.node_count(); ++i) body.positions(i, 0) *= 1.1;
  const BodyPicture picture = draw_body(body, {.width = 160, .height = 100});
  EXPECT_EQ(picture.quantity, "displacement (mm)");
  EXPECT_NEAR(picture.high, 20, 1e-9);
  const std::vector<std::uint8_t>& pixels = picture.image.pixels;
  EXPECT_TRUE(std::all_of(pixels.begin(), pixels.begin() + 3L * 160, [](int level) { return level > 250; }));
  const std::size_t middle = std::size_t{3} * (50U * 160U + 80U);
  EXPECT_LT(std::min({pixels[middle], pixels[middle + 1], pixels[middle + 2]}), 200);
  const BodyPicture strain = draw_body(body, {.color_by = ColorBy::kStrain, .width = 160, .height = 100});
  EXPECT_NEAR(strain.high, 100 * 0.5 * (1.1 * 1.1 - 1), 1e-9);
}

TEST(BodyPicture, ShowsAMembraneFromTheFront) {
  Membrane membrane = make_membrane(4, 2, {0.4, 0.2}, RectangleModel::kCalibrated, test::test_material(0.3));
  membrane.positions.col(0) *= 1.1;
  const BodyPicture picture = draw_membrane(membrane, {.width = 160, .height = 100});
  EXPECT_NEAR(picture.high, 40, 1e-9);
  const auto brightness = [&](std::size_t x, std::size_t y) { return picture.image.pixels[3 * (y * 160 + x)]; };
  EXPECT_GT(brightness(2, 2), 250);
  EXPECT_LT(brightness(60, 50), 200);
}

}  // namespace
}  // namespace sprung
