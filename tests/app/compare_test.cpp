#include <gtest/gtest.h>

#include "render/image/png.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

class Compare : public testing::Test {
 protected:
  Compare() {
    Image image(32, 16);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i % 200);
    write_png(image, folder_.path() / "a.png");
    image.pixels[0] = 190;  // 190 levels in one byte of the 192 in its block
    write_png(image, folder_.path() / "b.png");
    write_png(Image(16, 16), folder_.path() / "small.png");
  }
  ProgramRun run(const std::string& words) { return run_program(folder_, "compare " + words); }
  TempFolder folder_;
};

TEST_F(Compare, SaysHowMuchAndEndsAccordingly) {
  const ProgramRun same = run("a.png a.png");
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(same.out, "mean 0 of 255 (at most 0.4)\nworst block 0 of 255 (at most 6)\nSSIM 1.000000\nalike\n");
  EXPECT_EQ(run("a.png b.png").exit_code, 0);
  const ProgramRun strict = run("a.png b.png --worst-block 0.9");
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_NE(strict.out.find("worst block 0.9896 of 255 (at most 0.9)"), std::string::npos) << strict.out;
  EXPECT_NE(strict.out.find("\ndiffer\n"), std::string::npos);
  EXPECT_EQ(run("a.png b.png --mean 0.05").exit_code, 1);
}

TEST_F(Compare, OtherSizesDiffer) {
  const ProgramRun other = run("a.png small.png");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_EQ(other.out, "differ: 32 x 16 and 16 x 16 pixels\n");
}

TEST_F(Compare, DrawsTheDifference) {
  EXPECT_EQ(run("a.png b.png --difference d.png").exit_code, 0);
  const Image difference = read_png(folder_.path() / "d.png");
  EXPECT_NE(difference.pixels[0], difference.pixels[3]);
  EXPECT_EQ(difference.pixels[3], difference.pixels[6]);
  EXPECT_EQ(run("a.png b.png --difference d.png").exit_code, 2);
  EXPECT_EQ(run("a.png b.png --difference d.png --overwrite").exit_code, 0);
}

TEST_F(Compare, RefusesWhatIsNoPicture) {
  static_cast<void>(folder_.write("text.png", "text"));
  EXPECT_EQ(run("a.png text.png").exit_code, 3);
  EXPECT_EQ(run("a.png none.png").exit_code, 3);
  EXPECT_EQ(run("a.png").exit_code, 2);
  EXPECT_EQ(run("a.png b.png --mean -1").exit_code, 2);
}

}  // namespace
}  // namespace sprung
