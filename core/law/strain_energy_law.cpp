#include "core/law/strain_energy_law.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace sprung {
namespace {

constexpr double kMaxExponent = 100;

bool is_between(double value, double low, double high) { return value >= low && value <= high; }

std::string find_ogden_fault(const StrainEnergyLaw& law) {
  const std::vector<double>& exponents = law.ogden_exponents;
  if (exponents.empty() || exponents.size() > kMaxOgdenTerms) {
    return fmt::format("law ogden needs ogden_exponents, one to {} numbers like [1.3, 5.0]", kMaxOgdenTerms);
  }
  for (const double alpha : exponents) {
    if (!(std::abs(alpha) >= 0.01 && std::abs(alpha) <= kMaxExponent)) {
      return fmt::format("ogden_exponents has {:g}; each must be from 0.01 to {:g}, or as much below 0", alpha,
                         kMaxExponent);
    }
  }
  std::vector<double> shares = law.ogden_shares;
  if (shares.empty() && exponents.size() == 1) shares = {1};
  if (shares.size() != exponents.size()) {
    return fmt::format(
        "ogden_shares has {} numbers for {} ogden_exponents; give each exponent its share of the shear "
        "modulus",
        shares.size(), exponents.size());
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (const double share : shares) {
    if (!(share > 0)) return fmt::format("ogden_shares has {:g}; each must be above 0", share);
  }
  if (!(std::abs(sum - 1) < 1e-6)) return fmt::format("ogden_shares add up to {:g}; they must add up to 1", sum);
  double log_volume = 0;
  for (std::size_t p = 0; p < shares.size(); ++p) log_volume += shares[p] / exponents[p];
  if (!(log_volume > 0)) {
    return fmt::format(
        "the terms of ogden add up to {:g} (shares over exponents) and would let the solid be pressed "
        "flat; give the positive exponents a larger share",
        log_volume);
  }
  return "";
}

}  // namespace

std::string_view law_name(StrainEnergyKind kind) {
  return std::find_if(kLawNames.begin(), kLawNames.end(), [&](const auto& one) { return one.second == kind; })->first;
}

std::string parameters_text(const StrainEnergyLaw& law) {
  std::string text;
  if (law.mooney_share) text += fmt::format(", mooney_share = {}", *law.mooney_share);
  if (law.fung_exponent) text += fmt::format(", fung_exponent = {}", *law.fung_exponent);
  if (!law.ogden_exponents.empty()) text += fmt::format(", ogden_exponents = {}", law.ogden_exponents);
  if (!law.ogden_shares.empty()) text += fmt::format(", ogden_shares = {}", law.ogden_shares);
  return text;
}

std::string law_text(const StrainEnergyLaw& law) { return std::string(law_name(law.kind)) + parameters_text(law); }

std::string find_fault(const StrainEnergyLaw& law) {
  const auto belongs = [&](std::string_view key, bool is_given, StrainEnergyKind kind) {
    return is_given && law.kind != kind ? fmt::format("{} is of law {}, not {}; leave it out or change the law", key,
                                                      law_name(kind), law_name(law.kind))
                                        : "";
  };
  for (const std::string& fault :
       {belongs("mooney_share", law.mooney_share.has_value(), StrainEnergyKind::kMooneyRivlin),
        belongs("fung_exponent", law.fung_exponent.has_value(), StrainEnergyKind::kFung),
        belongs("ogden_exponents", !law.ogden_exponents.empty(), StrainEnergyKind::kOgden),
        belongs("ogden_shares", !law.ogden_shares.empty(), StrainEnergyKind::kOgden)}) {
    if (!fault.empty()) return fault;
  }
  switch (law.kind) {
    case StrainEnergyKind::kMooneyRivlin:
      if (!law.mooney_share) return "law mooney-rivlin needs mooney_share, C2 / (C1 + C2), from 0 to 1";
      if (!is_between(*law.mooney_share, 0, 1)) {
        return fmt::format("mooney_share is {:g}, it must be from 0 to 1", *law.mooney_share);
      }
      return "";
    case StrainEnergyKind::kFung:
      if (!law.fung_exponent) return "law fung needs fung_exponent, above 0";
      if (!is_between(*law.fung_exponent, 1e-6, kMaxExponent)) {
        return fmt::format("fung_exponent is {:g}, it must be above 0, at most {:g}", *law.fung_exponent, kMaxExponent);
      }
      return "";
    case StrainEnergyKind::kOgden:
      return find_ogden_fault(law);
    case StrainEnergyKind::kNeoHooke:
    case StrainEnergyKind::kLinear:
      break;
  }
  return "";
}

}  // namespace sprung
