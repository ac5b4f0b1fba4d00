#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/run_program.h"

/// `sprung load` at its defaults against quadratic tetrahedra of CalculiX (tests/references).
namespace sprung {

struct PartCase {
  std::string part;
  std::string name;
  std::string words;  // fix and load
};

inline void PrintTo(const PartCase& one, std::ostream* out) { *out << one.part << " " << one.name; }

inline nlohmann::json references() {
  return nlohmann::json::parse(text_of(SPRUNG_SOURCE_DIR "/tests/references/parts.json")).at("parts");
}

/// Points in the middle of walls carry little stress: their references are accurate to 10 % only.
inline bool is_in_the_middle(const std::string& point) { return point.find("mid_") != std::string::npos; }

/// Compares the displacement, the reactions and the stresses. `folder_of_mesh`: relative to which the part's mesh is
/// named.
inline void expect_reference(const PartCase& one, const std::filesystem::path& folder_of_mesh) {
  using Json = nlohmann::json;
  const Json part = references().at(one.part);
  const Json& expected = part.at("cases").at(one.name);
  const std::string file = (folder_of_mesh / part.at("mesh").get<std::string>()).string();
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
    const double allowed = std::max(0.02 * stress, 0.01 * 1e6 * peak);
    const double found = here.at("von_mises_Pa").at("value");
    if (is_in_the_middle(name)) continue;
    EXPECT_NEAR(found, stress, allowed) << name;
  }
}

}  // namespace sprung
