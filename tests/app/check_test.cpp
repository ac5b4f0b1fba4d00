#include <gtest/gtest.h>

#include "app/validate/check_text.h"
#include "tests/support/report.h"

namespace sprung {
namespace {

using test::kNone;

TEST(Check, PassesWithinItsTolerance) {
  EXPECT_TRUE(test::check("bend", "m1", 1, 1.009, 0.01).passed());
  EXPECT_FALSE(test::check("bend", "m1", 1, 1.011, 0.01).passed());
  EXPECT_FALSE(test::check("bend", "m1", 1, kNone, 0.01).passed());
  EXPECT_TRUE(test::check("bend", "m1", 1, 7).passed());
  EXPECT_FALSE(test::check("bend", "m1", 1, 7).is_gate());
}

TEST(Check, LowerBoundIsKeptByAllThatIsMore) {
  Check check = test::check("bend", "m1", 1, 3, 0);
  check.is_least = true;
  EXPECT_TRUE(check.passed());
  EXPECT_EQ(check.error(), 0);
  EXPECT_NE(check_line(check).find(">= 1"), std::string::npos);
  check.measured = 0.999;
  EXPECT_FALSE(check.passed());
  check.measured = kNone;
  EXPECT_FALSE(check.passed());
}

TEST(Check, TellsWhyThereIsNoResult) {
  Check check = test::check("bend", "m1", 1, kNone);
  check.trouble = "it broke";
  const std::string line = check_line(check);
  EXPECT_NE(line.find(" none  theory; not measured: it broke"), std::string::npos) << line;
  EXPECT_NE(checks_json({check}).find("\"trouble\": \"it broke\""), std::string::npos);
}

TEST(Check, TablesStandInColumns) {
  EXPECT_EQ(table_text({}), "");
  EXPECT_EQ(table_text({.head = {"a", "number"}, .rows = {{"long name", "1"}, {"b", "1234567"}}}),
            "a           number\nlong name        1\nb          1234567\n");
}

}  // namespace
}  // namespace sprung
