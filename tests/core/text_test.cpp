#include "core/text.h"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sprung {
namespace {

constexpr std::array<std::string_view, 4> kWords{"cork", "gelatin", "rubber", "steel"};

TEST(Nearest, FindsWhatIsMeant) {
  EXPECT_EQ(nearest_word("gelatine", kWords), "gelatin");
  EXPECT_EQ(nearest_word("ruber", kWords), "rubber");
  EXPECT_EQ(nearest_word("STEEL", kWords), "steel");
  EXPECT_EQ(nearest_word("crok", kWords), "cork");
  EXPECT_EQ(nearest_word("cram", kWords), "");  // three of four letters are another word
}

TEST(Nearest, GuessesNothingFarOff) {
  EXPECT_EQ(nearest_word("granite", kWords), "");
  EXPECT_EQ(nearest_word("", kWords), "");
}

TEST(Nearest, HintNamesTheWordOrAllOfThem) {
  EXPECT_EQ(did_you_mean("gelatine", kWords), "; did you mean 'gelatin'?");
  EXPECT_EQ(did_you_mean("granite", kWords), "; known are: cork, gelatin, rubber, steel");
}

TEST(Base64, FollowsTheStandardsExamples) {
  const auto encoded = [](const std::string& text) { return base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::byte>(3, std::byte{0xFF})), "////");
}

}  // namespace
}  // namespace sprung
