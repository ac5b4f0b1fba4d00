#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/law/material.h"

namespace sprung {

/// The measurements of a tension (or compression) test.
struct TensionCurve {
  std::vector<double> stretches;  // length over rest length, above 0
  std::vector<double> stresses;   // nominal: force over the area at rest, Pa; negative in compression
};

/// Reads a table with a stretch and a nominal stress a line, between them a comma, a semicolon or blanks: "1.5, 20
/// kPa"; a bare stress is in Pa, or in the unit of the head ("stretch,stress_MPa"). Empty lines and those that begin
/// with # are skipped. Throws Error(kBadInput) naming file, line and what is wrong with it.
[[nodiscard]] TensionCurve read_tension_curve(const std::filesystem::path& file);

/// A material's strain energy as a test has it.
struct CurveFit {
  double young = 0;  // at rest, Pa
  StrainEnergyLaw law{};
  double error = 0;          // root mean square of the stresses' errors, each over its stress or, if that is larger,
  double largest_error = 0;  // a twentieth of the largest stress
};

/// Fits Young's modulus and the parameters of `kind`, or of the simplest law that comes within a tenth of the best, to
/// a curve, for a solid of the given Poisson's ratio, by the method of Levenberg and Marquardt from several starts.
/// Throws Error(kBadInput) if fewer than three points differ from rest.
[[nodiscard]] CurveFit fit_curve(const TensionCurve& curve, double poisson, const StrainEnergyKind* kind = nullptr);

/// Sets Young's modulus, the law and the source of a material to what its curve has; `keeps_law`: of its law only the
/// parameters.
void fit_to_curve(Material& material, bool keeps_law);

/// "fitted to rubber.csv (24 points, stretch 1.02 to 7.61): 3.1 % off (root mean square), 8 % at most".
[[nodiscard]] std::string fit_text(const CurveFit& fit, const TensionCurve& curve, const std::filesystem::path& file);

}  // namespace sprung
