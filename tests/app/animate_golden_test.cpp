#include <gtest/gtest.h>

#include "render/image/png.h"
#include "tests/support/golden.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// The last picture of a short film, made by the program as a user would.
Image last_picture(const std::string& words, const std::string& picture) {
  const TempFolder folder;
  const ProgramRun run = run_program(folder, "animate '" SPRUNG_SOURCE_DIR "/assets/models/" + words +
                                                 " -o film --resolution 320x180 --fps 8 --duration 0.75 --quiet");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return read_png(folder.path() / "film" / picture);
}

TEST(AnimateGolden, DroppedDoughnut) {
  expect_golden(last_picture("torus.ply' --bricks 10 --young 10kPa --density 1050 --damping 0.02", "frame_0006.png"),
                "film_dropped_doughnut");
}

TEST(AnimateGolden, HangingKnot) {
  expect_golden(last_picture("knot.ply' --bricks 14 --young 6kPa --density 1050 --damping 0.02 --scenario hang",
                             "frame_0006.png"),
                "film_hanging_knot");
}

}  // namespace
}  // namespace sprung
