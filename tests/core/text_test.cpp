#include "core/text.h"

#include <gtest/gtest.h>

#include <vector>

namespace sprung {
namespace {

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
