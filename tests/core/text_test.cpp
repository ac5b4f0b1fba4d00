#include "core/text.h"

#include <gtest/gtest.h>

#include <array>

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

}  // namespace
}  // namespace sprung
