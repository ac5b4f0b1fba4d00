#include "render/image/png.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

class Png : public testing::Test {
 protected:
  [[nodiscard]] long files() const { return std::distance(std::filesystem::directory_iterator(folder_), {}); }

  TempFolder temp_;
  std::filesystem::path folder_ = temp_.path();
};

/// The message of the error of that kind which `act` throws.
template <class Act>
std::string error(ErrorKind kind, Act act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(int(error.kind()), int(kind));
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

Image noise(int width, int height) {
  Image image(width, height);
  unsigned state = 12345;
  for (auto& value : image.pixels) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<std::uint8_t>(state >> 24U);
  }
  return image;
}

TEST_F(Png, ReadsBackWhatWasWritten) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {64, 1}, {1, 64}, {321, 123}}) {
    const Image image = noise(width, height);
    write_png(image, folder_ / "noise.png");
    const Image back = read_png(folder_ / "noise.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.pixels, image.pixels);
  }
}

TEST_F(Png, LeavesOneFileAndReplacesTheOld) {
  write_png(noise(8, 8), folder_ / "a.png");
  write_png(noise(9, 9), folder_ / "a.png");
  EXPECT_EQ(read_png(folder_ / "a.png").width, 9);
  EXPECT_EQ(files(), 1);
}

TEST_F(Png, SmoothPicturesGetSmall) {
  Image image(256, 256);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) image.pixels[3 * (256 * y + x)] = static_cast<std::uint8_t>(x);
  }
  write_png(image, folder_ / "ramp.png");
  EXPECT_LT(std::filesystem::file_size(folder_ / "ramp.png"), 2000U);
}

TEST_F(Png, NamesTheMissingFolder) {
  const auto file = folder_ / "nowhere" / "a.png";
  const std::string message = error(ErrorKind::kFailed, [&] { write_png(noise(2, 2), file); });
  EXPECT_NE(message.find(file.string()), std::string::npos) << message;
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST_F(Png, NamesTheFolderThatCannotBeWritten) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const std::string message = error(ErrorKind::kFailed, [&] { write_png(noise(2, 2), folder_ / "a.png"); });
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
  EXPECT_NE(message.find("Permission denied"), std::string::npos) << message;
}

TEST_F(Png, LeavesNothingWhereItCannotTakeItsName) {
  std::filesystem::create_directories(folder_ / "a.png" / "inside");
  error(ErrorKind::kFailed, [&] { write_png(noise(2, 2), folder_ / "a.png"); });
  EXPECT_EQ(files(), 1);
}

TEST_F(Png, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  std::filesystem::create_symlink("/dev/full", folder_ / "a.png.partial");
  const std::string message = error(ErrorKind::kFailed, [&] { write_png(noise(64, 64), folder_ / "a.png"); });
  EXPECT_NE(message.find("No space left"), std::string::npos) << message;
}

TEST_F(Png, RefusesWhatIsNoPicture) {
  error(ErrorKind::kBadInput, [&] { (void)read_png(folder_ / "missing.png"); });
  std::ofstream(folder_ / "text.png") << "not a picture";
  const std::string message = error(ErrorKind::kBadInput, [&] { (void)read_png(folder_ / "text.png"); });
  EXPECT_NE(message.find("text.png"), std::string::npos) << message;

  write_png(noise(64, 64), folder_ / "cut.png");
  std::filesystem::resize_file(folder_ / "cut.png", 500);
  error(ErrorKind::kBadInput, [&] { (void)read_png(folder_ / "cut.png"); });
}

}  // namespace
}  // namespace sprung
