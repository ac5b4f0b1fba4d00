#include <gtest/gtest.h>

#include "app/film/film_output.h"
#include "tests/support/error_message.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

TEST(Output, FolderTakesNumberedFrames) {
  for (const std::string_view words : {"out", "out/"}) {
    const Output output = parse_output(words);
    EXPECT_EQ(output.kind, Output::Kind::kPictures);
    EXPECT_EQ(output.picture(1), std::filesystem::path("out/frame_0001.png"));
  }
  EXPECT_EQ(parse_output("out").picture(12345).filename(), "frame_12345.png");
}

TEST(Output, PatternsSayWhereTheNumberGoes) {
  EXPECT_EQ(parse_output("a/f_{:04}.png").picture(7), std::filesystem::path("a/f_0007.png"));
  EXPECT_EQ(parse_output("f_{:03d}x.PNG").picture(7), std::filesystem::path("f_007x.PNG"));
  EXPECT_EQ(parse_output("{}.png").picture(7), std::filesystem::path("7.png"));
  EXPECT_EQ(parse_output("a/f_%04d.png").picture(7), std::filesystem::path("a/f_0007.png"));
  EXPECT_EQ(parse_output("a#/f_####.png").picture(7), std::filesystem::path("a#/f_0007.png"));
  EXPECT_EQ(parse_output("c#_{:02}.png").picture(7), std::filesystem::path("c#_07.png"));
  EXPECT_EQ(parse_output("f_%d.png").picture(7), std::filesystem::path("f_7.png"));
  EXPECT_EQ(parse_output("a/p_{:04}.exr").picture(7), std::filesystem::path("a/p_0007.exr"));
  EXPECT_EQ(parse_output("a/p_{:04}.exr").kind, Output::Kind::kPasses);
}

TEST(Output, ANameWithoutNumberIsOfASinglePicture) {
  const Output still = parse_output("a/still.PNG");
  EXPECT_EQ(still.kind, Output::Kind::kPictures);
  EXPECT_FALSE(still.is_numbered());
  EXPECT_EQ(still.picture(12), std::filesystem::path("a/still.PNG"));
  EXPECT_EQ(parse_output("still.exr").kind, Output::Kind::kPasses);
  const TempFolder folder;
  const Output there = parse_output(folder.write("there.png", "").string());
  EXPECT_NE(error_message([&] { check_output(there, false); }).find("--overwrite"), std::string::npos);
  EXPECT_NO_THROW(check_output(there, true));
}

TEST(Output, FilmsAreKnownByTheirEnding) {
  for (const std::string_view words : {"a/film.mp4", "film.webm", "film.GIF"}) {
    EXPECT_EQ(parse_output(words).kind, Output::Kind::kFilm) << words;
    EXPECT_EQ(parse_output(words).file, std::filesystem::path(words));
  }
}

TEST(Output, RefusesWhatItCannotMake) {
  for (const std::string_view words :
       {"film.avi", "f_{:04}.jpg", "f_{:x}.png", "f_{}{}.png", "f_{.png", "{:04}/a.png", "f_%04x.png", ""}) {
    EXPECT_NE(error_message([&] { static_cast<void>(parse_output(words)); }).find("--output"), std::string::npos)
        << words;
  }
}

TEST(Output, ExistingPicturesAreKeptUnlessTold) {
  const TempFolder folder;
  const Output output = parse_output(folder.path().string());
  static_cast<void>(folder.write("frame_notes.png", ""));
  static_cast<void>(folder.write("frame_.png", ""));
  EXPECT_NO_THROW(check_output(output, false));
  static_cast<void>(folder.write("frame_0002.png", ""));
  EXPECT_EQ(existing_pictures(output).size(), 1U);
  EXPECT_NE(error_message([&] { check_output(output, false); }).find("--overwrite"), std::string::npos);
  EXPECT_NO_THROW(check_output(output, true));
}

TEST(Output, FolderBelowAFileCannotBeMade) {
  const TempFolder folder;
  const std::string file = folder.write("file", "").string();
  EXPECT_NE(error_message([&] { check_output(parse_output(file + "/out"), false); }).find("cannot make the folder"),
            std::string::npos);
}

TEST(Output, NamesWithAnUnknownEndingAreFoldersOnlyWhereThereIsOne) {
  const TempFolder folder;
  const std::string name = (folder.path() / "take.2").string();
  EXPECT_NE(error_message([&] { static_cast<void>(parse_output(name)); }).find("take.2/"), std::string::npos);
  EXPECT_EQ(parse_output(name + "/").kind, Output::Kind::kPictures);
  std::filesystem::create_directory(name);
  EXPECT_EQ(parse_output(name).kind, Output::Kind::kPictures);
}

TEST(Output, TwoThatMeanTheSamePlaceAreRefused) {
  const auto are_refused = [](const std::vector<std::string>& words) {
    return error_message([&] { static_cast<void>(parse_outputs(words)); }).find("same place") != std::string::npos;
  };
  EXPECT_TRUE(are_refused({"a", "./a/"}));
  EXPECT_TRUE(are_refused({"a", "b/../a/frame_{:02}.png"}));
  EXPECT_TRUE(are_refused({"f.gif", "./f.gif"}));
  EXPECT_TRUE(are_refused({"f.gif", "f.gif/"}));
  EXPECT_TRUE(are_refused({"f.gif/b/", "f.gif"}));
  EXPECT_FALSE(are_refused({"a", "b", "a/f.gif", "a/f_{}.png", "f.gif", "f.mp4"}));
}

TEST(Output, CheckingLeavesNothingBehind) {
  const TempFolder folder;
  check_output(parse_output((folder.path() / "a/b/c").string()), false);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace sprung
