#include "render/film.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/error.h"
#include "core/io/process.h"
#include "core/types.h"
#include "tests/support/error_message.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 256> part{};
  for (std::size_t count = 1; pipe != nullptr && count > 0;) {
    count = std::fread(part.data(), 1, part.size(), pipe);
    text.append(part.data(), count);
  }
  if (pipe != nullptr) pclose(pipe);
  return text;
}

/// One value a line, "key=value".
std::string probe(const std::filesystem::path& file) {
  return output_of(
      "ffprobe -v error -count_frames -select_streams v -show_entries stream=codec_name,width,height,"
      "nb_read_frames,pix_fmt,color_space,color_primaries,color_transfer,color_range,r_frame_rate "
      "-of default=noprint_wrappers=1 " +
      file.string());
}

/// The first pixel of the first frame, as RGB.
std::array<int, 3> first_pixel(const std::filesystem::path& file) {
  const std::string bytes = output_of("ffmpeg -v error -i " + file.string() +
                                      " -vf scale=in_color_matrix=bt709,format=rgb24,crop=1:1:8:8 -frames:v 1 -f "
                                      "rawvideo - | od -An -tu1");
  std::array<int, 3> rgb{-1, -1, -1};
  std::sscanf(bytes.c_str(), "%d %d %d", &rgb[0], &rgb[1], &rgb[2]);  // NOLINT(cert-err34-c)
  return rgb;
}

Image plain(int width, int height, std::array<int, 3> color) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(color[i % 3]);
  return image;
}

class Film : public testing::Test {
 protected:
  void SetUp() override {
    if (!find_program("ffmpeg") || !find_program("ffprobe")) GTEST_SKIP() << "no ffmpeg";
  }

  void write(const std::string& name, int width, int height, int frames, std::array<int, 3> color = {200, 60, 40}) {
    FilmWriter film(folder_ / name, {.width = width, .height = height, .fps = 24});
    for (int i = 0; i < frames; ++i) film.write(plain(width, height, color));
    film.close();
  }
  [[nodiscard]] long files() const { return std::distance(std::filesystem::directory_iterator(folder_), {}); }

  TempFolder temp_;
  std::filesystem::path folder_ = temp_.path();
};

TEST_F(Film, Mp4HasItsFramesSizeAndColourTags) {
  write("a.mp4", 64, 48, 10);
  const std::string facts = probe(folder_ / "a.mp4");
  for (const char* fact : {"codec_name=h264\n", "width=64\n", "height=48\n", "pix_fmt=yuv420p\n", "color_space=bt709\n",
                           "color_primaries=bt709\n", "color_transfer=bt709\n", "color_range=tv\n",
                           "nb_read_frames=10\n", "r_frame_rate=24/1\n"}) {
    EXPECT_NE(facts.find(fact), std::string::npos) << fact << facts;
  }
  EXPECT_EQ(files(), 1);
}

TEST_F(Film, KeepsColoursUnderItsTags) {
  const std::array<int, 3> color{200, 60, 40};
  for (const char* name : {"a.mp4", "a.webm"}) {
    write(name, 64, 48, 3, color);
    const std::array<int, 3> seen = first_pixel(folder_ / name);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], color[k], 4) << name;  // BT.601 would be off by 15
  }
}

TEST_F(Film, PadsOddSides) {
  write("odd.mp4", 63, 47, 3);
  const std::string facts = probe(folder_ / "odd.mp4");
  EXPECT_NE(facts.find("width=64\nheight=48\n"), std::string::npos) << facts;
}

TEST_F(Film, WritesWebmAndGif) {
  write("a.webm", 64, 48, 5);
  EXPECT_NE(probe(folder_ / "a.webm").find("codec_name=vp9\n"), std::string::npos);
  EXPECT_NE(probe(folder_ / "a.webm").find("nb_read_frames=5\n"), std::string::npos);
  write("a.GIF", 64, 48, 5);
  EXPECT_NE(probe(folder_ / "a.GIF").find("codec_name=gif\n"), std::string::npos);
}

TEST_F(Film, WritesProResAndUncompressed) {
  write("a.mov", 63, 47, 3);
  const std::string facts = probe(folder_ / "a.mov");
  for (const char* fact : {"codec_name=prores\n", "width=63\n", "height=47\n", "color_space=bt709\n"}) {
    EXPECT_NE(facts.find(fact), std::string::npos) << fact << facts;
  }
  write("a.y4m", 63, 47, 3);
  EXPECT_NE(probe(folder_ / "a.y4m").find("pix_fmt=yuv444p\n"), std::string::npos) << probe(folder_ / "a.y4m");
  for (const char* name : {"a.mov", "a.y4m"}) {
    const std::array<int, 3> seen = first_pixel(folder_ / name);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], (std::array{200, 60, 40})[k], 4) << name;
  }
}

TEST_F(Film, KeepsAlphaWhereTheFormatDoes) {
  Image picture = plain(63, 47, {200, 60, 40});
  for (std::size_t i = 0; i < picture.pixels.size() / 3; ++i) picture.alpha.push_back(i % 63 < 32 ? 0 : 255);
  for (const char* name : {"a.mov", "a.webm"}) {
    FilmWriter film(folder_ / name, {.width = 63, .height = 47, .fps = 24, .has_alpha = true});
    for (int i = 0; i < 2; ++i) film.write(picture);
    film.write(plain(63, 47, {200, 60, 40}));  // opaque
    film.close();
    const std::string decoder = std::string(name) == "a.webm" ? "-c:v libvpx-vp9 " : "";
    const std::string raw =
        output_of("ffmpeg -v error " + decoder + "-i '" + (folder_ / name).string() + "' -f rawvideo -pix_fmt rgba -");
    const std::size_t width = std::string(name) == "a.webm" ? 64 : 63;
    const std::size_t height = std::string(name) == "a.webm" ? 48 : 47;
    ASSERT_EQ(raw.size(), 3 * 4 * width * height) << name;
    const auto alpha = [&](std::size_t frame, std::size_t x) {
      return int(static_cast<unsigned char>(raw[4 * (frame * width * height + 20 * width + x) + 3]));
    };
    EXPECT_LT(alpha(0, 4), 5) << name;
    EXPECT_GT(alpha(0, 60), 250) << name;
    EXPECT_GT(alpha(2, 4), 250) << name;
  }
  EXPECT_NE(error_message([&] {
              FilmWriter(folder_ / "a.mp4", {.width = 64, .height = 48, .fps = 24, .has_alpha = true});
            }).find("have no alpha"),
            std::string::npos);
}

TEST_F(Film, WritesTheRatesOfNtscExactly) {
  const std::array<std::pair<double, const char*>, 6> rates{{{23.976, "24000/1001"},
                                                             {23.98, "24000/1001"},
                                                             {29.97, "30000/1001"},
                                                             {59.94, "60000/1001"},
                                                             {24, "24/1"},
                                                             {12.5, "25/2"}}};
  for (const auto& [fps, rate] : rates) {
    FilmWriter film(folder_ / "rate.mov", {.width = 16, .height = 16, .fps = fps});
    for (int i = 0; i < 3; ++i) film.write(plain(16, 16, {9, 9, 9}));
    film.close();
    const std::string facts = probe(folder_ / "rate.mov");
    EXPECT_NE(facts.find(std::string("r_frame_rate=") + rate + "\n"), std::string::npos) << fps << facts;
  }
}

TEST_F(Film, NamesFilmsByTheirEnding) {
  EXPECT_TRUE(is_film("a/b.mp4"));
  EXPECT_TRUE(is_film("B.WebM"));
  EXPECT_TRUE(is_film("c.gif"));
  EXPECT_FALSE(is_film("frame_{:04}.png"));
  EXPECT_FALSE(is_film("mp4"));
  EXPECT_THROW(FilmWriter(folder_ / "a.avi", {.width = 8, .height = 8, .fps = 24}), Error);
}

TEST_F(Film, MissingFolderIsSaidAtOnce) {
  try {
    FilmWriter film(folder_ / "nowhere" / "a.mp4", {.width = 8, .height = 8, .fps = 24});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kFailed);
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
}

TEST_F(Film, IsWrittenByOneAtATime) {
  const std::filesystem::path film = folder_ / "film.mp4";
  FilmWriter first(film, {.width = 32, .height = 16, .fps = 24});
  EXPECT_TRUE(is_film_being_written(film));
  EXPECT_NE(error_message([&] {
              FilmWriter(film, {.width = 32, .height = 16, .fps = 24});
            }).find("is being written by another run"),
            std::string::npos);
  first.write(Image(32, 16));
  first.close();
  EXPECT_FALSE(is_film_being_written(film));
  EXPECT_TRUE(std::filesystem::exists(film));
}

TEST_F(Film, AnUnfinishedFilmIsRemoved) {
  {
    FilmWriter film(folder_ / "a.mp4", {.width = 64, .height = 48, .fps = 24});
    film.write(plain(64, 48, {1, 2, 3}));
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(Film, SaysWhatFfmpegSaid) {
  try {
    FilmWriter film(folder_ / "a.mp4", {.width = 64, .height = 48, .fps = -1});  // no such frame rate: ffmpeg gives up
    for (int i = 0; i < 200; ++i) film.write(plain(64, 48, {1, 2, 3}));
    film.close();
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("video rate"), std::string::npos) << error.what();
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(Film, TellsWhereFfmpegIsMissing) {
  const std::string path = getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  EXPECT_THROW(require_ffmpeg(), Error);
  setenv("PATH", path.c_str(), 1);
  EXPECT_NO_THROW(require_ffmpeg());
}

TEST(ChildProcess, ADeadReaderIsNoSignal) {
  ChildProcess child({"false"});
  const std::vector<std::byte> data(1 << 22);
  EXPECT_FALSE(child.write(data));  // SIGPIPE would end this test
  EXPECT_EQ(child.finish(), 1);
}

TEST(ChildProcess, KeepsTheLastWords) {
  ChildProcess child({"sh", "-c", "cat >/dev/null; echo 'it broke' >&2; exit 7"});
  EXPECT_EQ(child.finish(), 7);
  EXPECT_EQ(child.error_output(), "it broke");
}

TEST(ChildProcess, AProgramThatIsMissingIsAnError) { EXPECT_THROW(ChildProcess({"sprung-no-such-program"}), Error); }

}  // namespace
}  // namespace sprung
