#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

/// `sprung load` at its defaults against quadratic tetrahedra of CalculiX (tests/references).
namespace sprung {
namespace {

using Json = nlohmann::json;

struct PartCase {
  std::string part;
  std::string name;
  std::string words;  // fix and load
};

void PrintTo(const PartCase& one, std::ostream* out) { *out << one.part << " " << one.name; }

class ReferenceParts : public testing::TestWithParam<PartCase> {};

Json references() { return Json::parse(text_of(SPRUNG_SOURCE_DIR "/tests/references/parts.json")).at("parts"); }

/// Points in the middle of walls carry little stress: their references are accurate to 10 % only.
bool is_in_the_middle(const std::string& point) { return point.find("mid_") != std::string::npos; }

TEST_P(ReferenceParts, DisplacementsStressesAndReactions) {
  const PartCase& one = GetParam();
  const Json part = references().at(one.part);
  const Json& expected = part.at("cases").at(one.name);
  std::string file = part.at("mesh");
  file = file.starts_with("shared/") ? SPRUNG_SHARED_MESHES + file.substr(std::string("shared/meshes").size())
                                     : SPRUNG_SOURCE_DIR "/" + file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  std::string points;
  for (const auto& [name, point] : expected.at("points").items()) {
    const std::vector<double> at = point.at("at");
    points += fmt::format(" --at={},{},{}", at[0], at[1], at[2]);
  }
  const TempFolder folder;
  const ProgramRun made = run_program(
      folder, "load '" + file + "' --young 2.1GPa --poisson 0.35 --analysis linear --json " + one.words + points);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Json answer = Json::parse(made.out);

  const double moved = answer.at("displacement_m").at("value");
  const double truth = 1e-3 * expected.at("max_displacement").get<double>();
  EXPECT_NEAR(moved, truth, 0.05 * truth);
  EXPECT_NEAR(moved, truth,
              answer.at("displacement_m").at("error").get<double>() + 0.005 * truth);  // the reference's own

  const std::vector<double> force = expected.at("reaction");
  const std::vector<double> held = answer.at("reactions").at(0).at("force_N");
  const double largest = std::hypot(force[0], force[1], force[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(held[axis], force[axis], 1e-3 * largest);

  std::size_t row = 0;
  const double peak = expected.at("max_von_mises_away");
  for (const auto& [name, point] : expected.at("points").items()) {
    const Json& here = answer.at("points").at(row++);
    const double stress = 1e6 * point.at("von_mises").get<double>();
    // Relative to the peak, if a point carries little compared with it.
    const double allowed = std::max(0.1 * stress, 0.03 * 1e6 * peak);
    const double found = here.at("von_mises_Pa").at("value");
    if (is_in_the_middle(name)) continue;
    EXPECT_NEAR(found, stress, allowed) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ReferenceParts,
    testing::Values(PartCase{"bracket", "fix_x_low", "--fix x-low --load x-high:50N:-y"},
                    PartCase{"bracket", "fix_y_high", "--fix y-high --load x-high:50N:-y"},
                    PartCase{"bracket_bent", "fix_x_low", "--fix x-low --load x-high:50N:-y"},
                    PartCase{"bracket_bent", "fix_y_high", "--fix y-high --load x-high:50N:-y"},
                    PartCase{"plate_holes", "pull_x", "--fix x-low --load x-high:100N:+x"},
                    PartCase{"plate_holes", "bend_z", "--fix x-low --load x-high:10N:-z"},
                    PartCase{"large_block_obb", "bend_z",
                             "--fix box=-1e9,-5,-1e9,1e9,7.8,1e9 --load box=-1e9,2894.8,-1e9,1e9,2910,1e9:1000N:-z"},
                    PartCase{"large_block_obb", "push_x",
                             "--fix box=-1e9,-5,-1e9,1e9,7.8,1e9 --load box=-1e9,2894.8,-1e9,1e9,2910,1e9:1000N:+x"}));

}  // namespace
}  // namespace sprung
