#include "app/film/draw_diverged.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "render/image/png.h"
#include "tests/support/bodies.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

std::string message_of(const World& world, const std::filesystem::path& picture) {
  try {
    static_cast<void>(
        with_picture_of_diverged(world, picture, []() -> Recording { throw Diverged(0, "no end in sight"); }));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kDiverged);
    return error.what();
  }
  return "";
}

TEST(DrawDiverged, LeavesAPictureOfTheBricksAndNamesIt) {
  const TempFolder folder;
  World world;
  world.bodies.emplace_back(make_body(make_box_grid({4, 2, 2}, 0.02), Model::kCalibrated, test::test_material(0.3)));
  world.bodies[0].positions(3, 1) += 0.01;
  const std::filesystem::path picture = folder.path() / "out" / "diverged.png";
  const std::string message = message_of(world, picture);
  EXPECT_EQ(message.find("no end in sight; "), 0U) << message;
  EXPECT_NE(message.find(picture.string()), std::string::npos) << message;
  const Image image = read_png(picture);
  const Image plain = Image(image.width, image.height);
  EXPECT_NE(image.pixels, plain.pixels);

  world.bodies[0].positions(3, 1) = std::nan("");
  EXPECT_EQ(message_of(world, folder.path() / "none.png"), "no end in sight");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.png"));
}

}  // namespace
}  // namespace sprung
