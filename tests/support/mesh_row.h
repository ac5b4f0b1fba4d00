#pragma once
#include <gtest/gtest.h>

#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "tests/support/json_number.h"
#include "tests/support/refusal.h"
#include "tests/support/sanitized.h"

namespace sprung {

/// The properties of a mesh file and what `sprung inspect` must say of it.
struct MeshRow {
  std::string file;
  double vertices;  // 0: the file must be refused
  double triangles;
  bool is_closed;
  double solids;
  std::optional<double> volume;      // cubed units of the file
  std::vector<std::string> repairs;  // kinds that must be named; a file without any works as it is
  std::string words;                 // that a warning must have, or the refusal
};

inline void PrintTo(const MeshRow& row, std::ostream* out) { *out << row.file; }

inline MeshRow refused(std::string file, std::string words) {
  return {std::move(file), 0, 0, false, 0, {}, {}, std::move(words)};
}

/// The kinds of repair in it that are worth a warning.
inline std::set<std::string> repairs_in(const std::string& report) {
  std::set<std::string> kinds;
  const std::string key = "\"kind\": \"";
  for (std::size_t at = report.find(key); at < report.find("\"bodies\""); at = report.find(key, at)) {
    at += key.size();
    kinds.insert(report.substr(at, report.find('"', at) - at));
  }
  for (const char* harmless : {"welded", "unreferenced", "cavity"}) kinds.erase(harmless);
  return kinds;
}

/// Gives the file to the built program, in a folder. `bricks`: along its longest side.
inline void expect_row(const TempFolder& folder, const std::string& file, const MeshRow& row, int bricks) {
  if (row.vertices == 0) return expect_refusal(folder, file, row.words);

  const ProgramRun made =
      run_program(folder, "inspect '" + file + "' --json --resolution 160x120 --bricks " + std::to_string(bricks));
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string& report = made.out;
  EXPECT_EQ(number_at(report, {"mesh", "vertices"}), row.vertices);
  EXPECT_EQ(number_at(report, {"mesh", "triangles"}), row.triangles);
  EXPECT_NE(report.find(row.is_closed ? "\"closed\": true" : "\"closed\": false"), std::string::npos) << report;
  EXPECT_EQ(number_at(report, {"mesh", "solids"}), row.solids);
  if (!test::kSanitized) {
    EXPECT_EQ(number_at(report, {"bricks", "solids"}), row.solids) << "parts came apart, or stayed connected";
  }
  if (row.volume) {
    EXPECT_NEAR(number_at(report, {"mesh", "volume"}) / *row.volume, 1, 1e-3);
    EXPECT_NEAR(number_at(report, {"bricks", "volume"}) / *row.volume, 1, test::kSanitized ? 0.05 : 5e-3);
  }
  EXPECT_LT(std::abs(number_at(report, {"volume_error"})), test::kSanitized ? 0.02 : 1e-3)
      << "the mass is density times the volume";
  const std::set<std::string> named = repairs_in(report);
  for (const std::string& kind : row.repairs) EXPECT_TRUE(named.contains(kind)) << kind;
  EXPECT_EQ(named.empty(), row.repairs.empty()) << report;
  const std::string warnings =
      report.substr(report.find("\"warnings\""), report.find("\"bodies\"") - report.find("\"warnings\""));
  EXPECT_NE(warnings.find(row.words), std::string::npos) << warnings;
}

}  // namespace sprung
