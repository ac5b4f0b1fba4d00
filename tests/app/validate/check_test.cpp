#include "app/validate/check.h"

#include <gtest/gtest.h>

#include "tests/support/report.h"

namespace sprung {
namespace {

TEST(Check, PassesWithinItsTolerance) {
  EXPECT_TRUE(test::check("bend", "m1", 1, 1.009, 0.01).passed());
  EXPECT_FALSE(test::check("bend", "m1", 1, 1.011, 0.01).passed());
  EXPECT_FALSE(test::check("bend", "m1", 1, kNaN, 0.01).passed());
  EXPECT_TRUE(test::check("bend", "m1", 1, 7).passed());
  EXPECT_FALSE(test::check("bend", "m1", 1, 7).is_gate());
}

TEST(Check, SaysWhyThereIsNoResult) {
  Check check = test::check("bend", "m1", 1, kNaN);
  check.trouble = "it broke";
  const std::string line = check_line(check);
  EXPECT_NE(line.find(" none  theory; not measured: it broke"), std::string::npos) << line;
  EXPECT_NE(checks_json({check}).find("\"trouble\": \"it broke\""), std::string::npos);
}

/// Tiny errors are not rounded to zero, and an expected zero makes them absolute.
TEST(Check, WritesErrors) {
  EXPECT_EQ(error_text(test::check("bend", "m1", 1, 0.9988)), "-0.12 %");
  EXPECT_EQ(error_text(test::check("bend", "m1", 1, 1 + 2e-7)), "2e-05 %");
  EXPECT_EQ(error_text(test::check("bend", "m1", 1, kNaN)), "-");
  Check check = test::check("bend", "m1", 1, 0.00123, 0.01);
  check.expected = 0;
  EXPECT_EQ(error_text(check), "0.0012");
  EXPECT_EQ(tolerance_text(check), "0.01");
  check.unit = '%';
  EXPECT_EQ(error_text(check), "0.001 %");
}

TEST(Check, JsonHasNullForWhatIsNoNumber) {
  const std::string json = checks_json({test::check("bend \"it\"", "m1", 1, kNaN)});
  for (const char* part : {"\"experiment\": \"bend \\\"it\\\"\"", "\"measured\": null", "\"tolerance\": null",
                           "\"passed\": null", "\"poisson\": 0.3"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << " in " << json;
  }
}

TEST(Check, TablesAreAligned) {
  EXPECT_EQ(table_text({}), "");
  EXPECT_EQ(table_text({.head = {"a", "number"}, .rows = {{"long name", "1"}, {"b", "1234567"}}}),
            "a           number\nlong name        1\nb          1234567\n");
}

}  // namespace
}  // namespace sprung
