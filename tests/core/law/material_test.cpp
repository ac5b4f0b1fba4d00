#include "core/law/material.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/error_message.h"

namespace sprung {
namespace {

TEST(Material, ModuliFollowFromYoungAndPoisson) {
  const Material material{.name = "test", .young = 30e3, .poisson = 0.25, .density = 1000, .damping = 0, .source = ""};
  EXPECT_DOUBLE_EQ(material.shear_modulus(), 12e3);
  EXPECT_DOUBLE_EQ(material.lame_lambda(), 12e3);
}

TEST(Material, ChecksNameTheQuantity) {
  const auto message = [](auto field, double value) {
    Material material;
    material.*field = value;
    return error_message([&] { check_material(material); });
  };
  EXPECT_NE(message(&Material::young, 0).find("Young"), std::string::npos);
  EXPECT_NE(message(&Material::young, std::numeric_limits<double>::quiet_NaN()).find("Young"), std::string::npos);
  EXPECT_NE(message(&Material::poisson, 0.5).find("Poisson"), std::string::npos);
  EXPECT_NE(message(&Material::poisson, -1).find("Poisson"), std::string::npos);
  EXPECT_NE(message(&Material::density, -3).find("density"), std::string::npos);
  EXPECT_NE(message(&Material::damping, -0.1).find("damping"), std::string::npos);
  EXPECT_EQ(message(&Material::poisson, -0.5), "");
}

}  // namespace
}  // namespace sprung
