#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>
#include <utility>

#include "app/scene/tension_curve.h"
#include "core/error.h"
#include "core/law/solid/uniaxial.h"

namespace sprung {
namespace {

constexpr double kMinShare = 0.05;  // of the largest stress, under an error
constexpr double kTooFar = 10;      // the relative error of a curve that a law cannot follow

using Parameters = Eigen::VectorXd;

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

/// A law by numbers without bounds, the first the logarithm of Young's modulus.
struct Family {
  StrainEnergyKind kind;
  std::vector<std::vector<double>> starts;  // without that of Young's modulus
  std::function<void(const Parameters&, StrainEnergyLaw&)> set;

  [[nodiscard]] std::size_t size() const { return 1 + starts.front().size(); }
};

std::vector<Family> families() {
  std::vector<Family> all;
  all.push_back({StrainEnergyKind::kNeoHooke, {{}}, [](const Parameters&, StrainEnergyLaw&) {}});
  all.push_back({StrainEnergyKind::kLinear, {{}}, [](const Parameters&, StrainEnergyLaw&) {}});
  all.push_back({StrainEnergyKind::kMooneyRivlin, {{0}, {-3}, {3}}, [](const Parameters& x, StrainEnergyLaw& law) {
                   law.mooney_share = logistic(x[1]);
                 }});
  all.push_back({StrainEnergyKind::kFung, {{-3}, {0}, {2}}, [](const Parameters& x, StrainEnergyLaw& law) {
                   law.fung_exponent = std::exp(std::clamp(x[1], -10.0, 4.5));
                 }});
  all.push_back({StrainEnergyKind::kOgden, {{0}, {1.5}, {2.5}}, [](const Parameters& x, StrainEnergyLaw& law) {
                   law.ogden_exponents = {std::exp(std::clamp(x[1], -3.0, 4.0))};
                 }});
  // A second term that acts when the solid is stretched far, or pressed.
  for (const double sign : {1.0, -1.0}) {
    all.push_back(
        {StrainEnergyKind::kOgden,
         {{0.2, 1.6, -2}, {0.5, 1, -1}, {0.2, 2, -5}},
         [sign](const Parameters& x, StrainEnergyLaw& law) {
           const double share = logistic(x[3]);
           law.ogden_exponents = {std::exp(std::clamp(x[1], -3.0, 4.0)), sign * std::exp(std::clamp(x[2], -3.0, 4.0))};
           law.ogden_shares = {1 - share, share};
         }});
  }
  return all;
}

/// The errors of a law with given parameters, as Eigen's optimiser wants them.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const TensionCurve& curve;
  const Family& family;
  double poisson;
  double least;  // stress under an error, Pa

  [[nodiscard]] int inputs() const { return int(family.size()); }
  [[nodiscard]] int values() const { return std::max(int(curve.stretches.size()), inputs()); }

  [[nodiscard]] Material material(const Parameters& x) const {
    Material material;
    material.young = std::exp(std::clamp(x[0], -10.0, 40.0));
    material.poisson = poisson;
    material.law.kind = family.kind;
    family.set(x, material.law);
    return material;
  }

  int operator()(const Parameters& x, Eigen::VectorXd& errors) const {
    errors = Eigen::VectorXd::Zero(values());
    const Material tried = material(x);
    if (!find_fault(tried.law).empty()) {
      errors.setConstant(kTooFar);
      return 0;
    }
    const StrainEnergy psi(tried);
    for (std::size_t i = 0; i < curve.stretches.size(); ++i) {
      const double error = (uniaxial_state(psi, curve.stretches[i]).stress - curve.stresses[i]) /
                           std::max(std::abs(curve.stresses[i]), least);
      errors[Eigen::Index(i)] = std::isfinite(error) ? std::clamp(error, -kTooFar, kTooFar) : kTooFar;
    }
    return 0;
  }
};

/// Young's modulus as the points nearest to rest have it, Pa.
double first_guess(const TensionCurve& curve) {
  double nearest = std::numeric_limits<double>::infinity();
  double young = 0;
  for (std::size_t i = 0; i < curve.stretches.size(); ++i) {
    const double strain = curve.stretches[i] - 1;
    if (strain == 0 || curve.stresses[i] == 0 || std::abs(strain) > nearest) continue;
    nearest = std::abs(strain);
    young = curve.stresses[i] / strain;
  }
  return young;
}

CurveFit fit_family(const TensionCurve& curve, const Family& family, double poisson) {
  double largest = 0;
  for (const double stress : curve.stresses) largest = std::max(largest, std::abs(stress));
  Eigen::NumericalDiff<Residuals> residuals(Residuals{curve, family, poisson, kMinShare * largest});
  CurveFit best{.error = std::numeric_limits<double>::infinity()};
  for (const std::vector<double>& start : family.starts) {
    Parameters x(family.size());
    x[0] = std::log(first_guess(curve));
    for (std::size_t i = 0; i < start.size(); ++i) x[Eigen::Index(i) + 1] = start[i];
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> optimiser(residuals);
    optimiser.parameters.maxfev = 400;
    optimiser.minimize(x);
    Eigen::VectorXd errors;
    residuals(x, errors);
    const double error = errors.norm() / std::sqrt(double(curve.stretches.size()));
    if (error >= best.error) continue;
    const Material material = residuals.material(x);
    best = {
        .young = material.young, .law = material.law, .error = error, .largest_error = errors.cwiseAbs().maxCoeff()};
  }
  return best;
}

/// With four digits, which is more than a test is worth.
double rounded(double value) { return std::stod(fmt::format("{:.4g}", value)); }

void round_parameters(CurveFit& fit) {
  fit.young = rounded(fit.young);
  if (fit.law.mooney_share) fit.law.mooney_share = rounded(*fit.law.mooney_share);
  if (fit.law.fung_exponent) fit.law.fung_exponent = rounded(*fit.law.fung_exponent);
  for (double& exponent : fit.law.ogden_exponents) exponent = rounded(exponent);
  std::vector<double>& shares = fit.law.ogden_shares;
  if (shares.empty()) return;
  const auto largest = std::max_element(shares.begin(), shares.end());
  double others = 0;
  for (double& share : shares) {
    if (&share != &*largest) others += share = rounded(share);
  }
  constexpr double kDigits = 1e10;
  *largest = std::round(kDigits * (1 - others)) / kDigits;
}

}  // namespace

CurveFit fit_curve(const TensionCurve& curve, double poisson, const StrainEnergyKind* kind) {
  constexpr std::size_t kMinPoints = 3;
  constexpr double kNotWorse = 1.1;
  constexpr double kEqual = 1e-4;
  std::size_t points = 0;
  for (std::size_t i = 0; i < curve.stretches.size(); ++i) {
    if (curve.stretches[i] != 1 && curve.stresses[i] != 0) ++points;
  }
  if (points < kMinPoints) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("a law is fitted to three points away from rest or more; the curve has {}", points));
  }
  std::vector<std::pair<std::size_t, CurveFit>> fits;  // by the number of their parameters
  for (const Family& family : families()) {
    const bool is_wanted = kind != nullptr ? family.kind == *kind : family.kind != StrainEnergyKind::kLinear;
    if (!is_wanted || family.size() > points) continue;
    fits.emplace_back(family.size(), fit_family(curve, family, poisson));
  }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [size, fit] : fits) least = std::min(least, fit.error);
  const auto rank = [&](const std::pair<std::size_t, CurveFit>& one) {
    const auto& [size, fit] = one;
    return std::tuple(fit.error > kNotWorse * least + kEqual, size, fit.error);
  };
  CurveFit chosen = std::min_element(fits.begin(), fits.end(), [&](const auto& a, const auto& b) {
                      return rank(a) < rank(b);
                    })->second;
  round_parameters(chosen);
  return chosen;
}

}  // namespace sprung
