#include "tests/support/golden.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "render/image/png.h"

namespace sprung {

namespace {

const std::filesystem::path kGoldens = SPRUNG_GOLDEN_DIR;
const std::filesystem::path kKept = SPRUNG_KEEP_DIR;

/// Keeps the picture; the words that say where, and how to accept it.
std::string keep(const Image& image, const std::string& name) {
  std::filesystem::create_directories(kKept);
  const std::filesystem::path file = kKept / (name + ".png");
  write_png(image, file);
  return fmt::format("the picture is kept as {}; if it is right: tests/accept-goldens {} {}", file.string(),
                     kKept.string(), name);
}

}  // namespace

void expect_golden(const Image& image, const std::string& name, const GoldenTolerance& tolerance) {
  EXPECT_TRUE(image.width <= 320 && image.height <= 240) << "goldens are at most 320 x 240";
  const std::filesystem::path file = kGoldens / (name + ".png");
  if (!std::filesystem::exists(file)) {
    ADD_FAILURE() << "there is no golden " << file << "; " << keep(image, name);
    return;
  }
  const Image golden = read_png(file);
  if (!same_size(image, golden)) {
    ADD_FAILURE() << fmt::format("{} is {}x{}, the picture {}x{}; ", name, golden.width, golden.height, image.width,
                                 image.height)
                  << keep(image, name);
    return;
  }
  const ImageDifference difference = compare_images(image, golden);
  if (difference.mean <= tolerance.mean && difference.worst_block <= tolerance.worst_block) return;
  const std::string kept = keep(image, name);
  write_png(difference_picture(image, golden), kKept / (name + ".difference.png"));
  ADD_FAILURE()
      << fmt::format(
             "{} differs from its golden: mean {:.3f} (tolerance {}), worst block {:.2f} (tolerance {}) levels; ", name,
             difference.mean, tolerance.mean, difference.worst_block, tolerance.worst_block)
      << kept;
}

}  // namespace sprung
