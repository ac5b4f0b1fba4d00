#include "tests/support/golden.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "render/image/png.h"

namespace sprung {
namespace {

TEST(CompareImages, FindsTheMeanAndTheWorstBlock) {
  const Image black(20, 12);  // blocks at the right and the bottom are cut
  EXPECT_EQ(compare_images(black, black).mean, 0);
  Image spot = black;
  spot.pixels[0] = 192;  // one byte of the 192 in the first block
  EXPECT_DOUBLE_EQ(compare_images(black, spot).worst_block, 1);
  EXPECT_DOUBLE_EQ(compare_images(spot, black).mean, 192.0 / (3 * 20 * 12));
  Image corner = black;
  corner.pixels.back() = 48;  // one byte of the 4 x 4 pixels in the last block
  EXPECT_DOUBLE_EQ(compare_images(black, corner).worst_block, 1);
}

// The golden is a black picture of 16 x 16 pixels.
TEST(ExpectGolden, FailsKeepsAndNamesTheCommand) {
  const std::filesystem::path kept = SPRUNG_KEEP_DIR;
  expect_golden(Image(16, 16), "golden_self_test");
  EXPECT_FALSE(std::filesystem::exists(kept / "golden_self_test.png"));

  Image other(16, 16);
  other.pixels[0] = 192;
  other.pixels[1] = 192;
  expect_golden(other, "golden_self_test", {1.0, 2.5});
  EXPECT_NONFATAL_FAILURE(expect_golden(other, "golden_self_test", {1.0, 1.5}), "worst block 2.00");
  EXPECT_NONFATAL_FAILURE(expect_golden(other, "golden_self_test", {0.4, 2.5}), "tests/accept-goldens");
  EXPECT_EQ(read_png(kept / "golden_self_test.difference.png").pixels[0], 255);
  EXPECT_NONFATAL_FAILURE(expect_golden(Image(8, 8), "golden_self_test"), "is 16x16, the picture 8x8");
  EXPECT_NONFATAL_FAILURE(expect_golden(Image(8, 8), "no_such_golden"), "there is no golden");
  for (const char* name : {"golden_self_test.png", "golden_self_test.difference.png", "no_such_golden.png"}) {
    EXPECT_TRUE(std::filesystem::remove(kept / name)) << name;
  }
}

}  // namespace
}  // namespace sprung
