#pragma once

#include <string>

namespace sprung {

// One line of `sprung validate`: a quantity an experiment measured and what it was expected to be.
struct Check {
  std::string experiment;
  std::string quantity;
  std::string model;
  double poisson{0};
  std::string grid;         // bricks along x, y, z: "8x2x2"
  double bricks_across{0};  // across the thickness
  double measured{0};       // NaN where the experiment could not be carried through
  double expected{0};
  std::string unit;
  std::string source;     // of the expectation
  double tolerance{0};    // relative (absolute where 0 is expected); NaN: informative only
  bool is_least{false};   // expected is a lower bound: more than that is no error
  std::string trouble{};  // why nothing was measured; empty: it was

  // measured / expected - 1; the plain difference where 0 is expected; 0 where a lower bound is kept.
  [[nodiscard]] double error() const;
  // Whether the check can fail the run.
  [[nodiscard]] bool is_gate() const;
  [[nodiscard]] bool passed() const;
};

}  // namespace sprung
