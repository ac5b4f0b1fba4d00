#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/validate/node_errors.h"
#include "core/law/brick_law.h"

namespace sprung {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A measured quantity of one run and its expected value.
struct Check {
  std::string experiment{};
  std::string quantity{};
  std::string model{};
  double poisson = 0;
  std::string grid{};        // bricks along x, y, z: "8x2x2"
  double bricks_across = 0;  // over the thickness
  double measured = kNaN;    // NaN if the run failed
  double expected = 0;
  std::string unit{};
  std::string source{};     // of the expected value
  double tolerance = kNaN;  // relative (absolute if 0 is expected); NaN: reported only
  std::string trouble{};    // why the run failed

  /// measured / expected - 1; the difference if 0 is expected.
  [[nodiscard]] double error() const;
  /// Returns whether the check has a tolerance and can fail.
  [[nodiscard]] bool is_gate() const;
  [[nodiscard]] bool passed() const;
};

/// Text and numbers in rows as long as the head.
struct TextTable {
  std::vector<std::string> head{};
  std::vector<std::vector<std::string>> rows{};
};

/// The model, Poisson's ratio and number of bricks that replace those a case varies.
struct Choice {
  std::optional<Model> model;
  std::optional<double> poisson;
  std::optional<int> bricks;

  [[nodiscard]] bool is_any() const { return model || poisson || bricks; }
};

/// The result of a case.
struct CaseResult {
  std::vector<Check> checks{};
  std::vector<NodeErrors> node_errors{};  // of runs with a reference solution at the nodes
  TextTable table{};                      // may be empty
};

/// Six digits; "-" for NaN, as in all of these.
[[nodiscard]] std::string number_text(double value);
/// "1.23 %", "2e-05 %"; a plain number if 0 is expected.
[[nodiscard]] std::string error_text(const Check& check);
[[nodiscard]] std::string tolerance_text(const Check& check);
/// The source of the expected value, and why the run failed if it did.
[[nodiscard]] std::string source_text(const Check& check);

/// A line with columns: experiment, quantity, model, Poisson's ratio, grid, measured, expected, unit, error, tolerance,
/// result, source.
[[nodiscard]] std::string check_line(const Check& check);

/// The table in aligned columns, one line per row; empty if it has no rows.
[[nodiscard]] std::string table_text(const TextTable& table);

/// All checks as a JSON array; numbers that are not finite are null, and so is `passed` of checks without a tolerance.
[[nodiscard]] std::string checks_json(const std::vector<Check>& checks);

}  // namespace sprung
