#include "core/units.h"

#include <gtest/gtest.h>

#include "tests/support/error_message.h"

namespace sprung {
namespace {

TEST(Units, BareNumbersAreInTheBaseUnit) {
  EXPECT_DOUBLE_EQ(parse_quantity("0.03", Dimension::kLength), 0.03);
  EXPECT_DOUBLE_EQ(parse_quantity("-9.81", Dimension::kAcceleration), -9.81);
  EXPECT_DOUBLE_EQ(parse_quantity("+2e4", Dimension::kPressure), 2e4);
  EXPECT_DOUBLE_EQ(parse_quantity("45", Dimension::kAngle), 45);
}

TEST(Units, UnitsWithAndWithoutSpace) {
  EXPECT_DOUBLE_EQ(parse_quantity("3 cm", Dimension::kLength), 0.03);
  EXPECT_DOUBLE_EQ(parse_quantity("3cm", Dimension::kLength), 0.03);
  EXPECT_DOUBLE_EQ(parse_quantity(" 20 kPa ", Dimension::kPressure), 20e3);
  EXPECT_DOUBLE_EQ(parse_quantity("1.2 g/cm3", Dimension::kDensity), 1200);
  EXPECT_DOUBLE_EQ(parse_quantity("500 ms", Dimension::kTime), 0.5);
  EXPECT_DOUBLE_EQ(parse_quantity("24 fps", Dimension::kRate), 24);
  EXPECT_DOUBLE_EQ(parse_quantity("36 km/h", Dimension::kSpeed), 10);
  EXPECT_DOUBLE_EQ(parse_quantity("3 %", Dimension::kRatio), 0.03);
  EXPECT_NEAR(parse_quantity("3.141592653589793 rad", Dimension::kAngle), 180, 1e-12);
}

TEST(Units, CaseTellsUnitsApart) {
  EXPECT_DOUBLE_EQ(parse_quantity("1 MPa", Dimension::kPressure), 1e6);
  EXPECT_THROW(static_cast<void>(parse_quantity("1 mpa", Dimension::kPressure)), Error);
}

TEST(Units, ErrorsNameTheTextAndTheUnits) {
  const auto message = [](std::string_view text, Dimension dimension) {
    return error_message([&] { static_cast<void>(parse_quantity(text, dimension)); });
  };
  const std::string wrong = message("3 parsec", Dimension::kLength);
  EXPECT_NE(wrong.find("'3 parsec'"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("mm, cm"), std::string::npos) << wrong;
  EXPECT_NE(message("fast", Dimension::kTime).find("is no number"), std::string::npos);
  EXPECT_NE(message("", Dimension::kTime).find("is no number"), std::string::npos);
  EXPECT_NE(message("nan", Dimension::kTime), "");
  EXPECT_NE(message("1e999", Dimension::kTime).find("out of range"), std::string::npos);
  EXPECT_NE(message("0.4 Pa", Dimension::kNone).find("takes no unit"), std::string::npos);
  EXPECT_NE(message("3 s", Dimension::kLength), "");
  EXPECT_NE(message("12,5cm", Dimension::kLength).find("has a comma where the decimal point goes"), std::string::npos);
}

TEST(Units, WholeNumbersAreWhole) {
  EXPECT_EQ(parse_whole(" 24 "), 24);
  for (const std::string_view text : {"24.5", "24x", "", "99999999999"}) {
    EXPECT_THROW(static_cast<void>(parse_whole(text)), Error) << text;
  }
}

TEST(Units, ReadableTakesTheLargestUnitThatKeepsTheNumberAtOneOrAbove) {
  EXPECT_EQ(readable(24e3, Dimension::kPressure), "24 kPa");
  EXPECT_EQ(readable(68.9e9, Dimension::kPressure), "68.9 GPa");
  EXPECT_EQ(readable(0.00833, Dimension::kLength), "8.33 mm");
  EXPECT_EQ(readable(0.2, Dimension::kLength), "20 cm");
  EXPECT_EQ(readable(1.5e-4, Dimension::kTime), "150 us");
  EXPECT_EQ(readable(1e-9, Dimension::kTime), "0.001 us");
}

}  // namespace
}  // namespace sprung
