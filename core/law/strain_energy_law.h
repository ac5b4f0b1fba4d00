#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sprung {

/// The strain-energy density psi of a solid. All have the material's Young's modulus and Poisson's ratio at rest and
/// differ at large strains. With I1 = F : F, I2 the second invariant of F^T F, J = det F, s_i the principal stretches
/// and Lame's G and lambda:
enum class StrainEnergyKind {
  /// G/2 (I1 - 3) - G log J + lambda/2 (J - 1)^2
  kNeoHooke,
  /// c the Mooney share, C2 / (C1 + C2):
  /// G/2 ((1 - c) (I1 - 3) + c (I2 - 3)) - (1 + c) G log J + (lambda - 2 c G)/2 (J - 1)^2
  kMooneyRivlin,
  /// w_p the shares of the terms in G, which add up to 1:
  /// sum over p: 2 G w_p / alpha_p^2 (s_1^alpha_p + s_2^alpha_p + s_3^alpha_p - 3 - alpha_p log J) + lambda/2 (J - 1)^2
  kOgden,
  /// G / (2 b) (exp(2 b W / G) - 1) with W that of kNeoHooke, which is b (I1 - 3) without change of volume: for tissues
  kFung,
  /// lambda/2 tr(E)^2 + G E : E with Green's strain E: St. Venant and Kirchhoff's, linear between that strain and its
  /// conjugate stress. It gives way in compression beyond 42 %.
  kLinear
};

/// A choice of psi with the parameters that E and nu leave open. Sources: Mooney, J. Appl. Phys. 11, 582 (1940);
/// Rivlin, Phil. Trans. A 241, 379 (1948); Ogden, Proc. R. Soc. A 326, 565 (1972); Fung, Am. J. Physiol. 213, 1532
/// (1967), in the form of Demiray, J. Biomech. 5, 309 (1972).
struct StrainEnergyLaw {
  StrainEnergyKind kind = StrainEnergyKind::kNeoHooke;
  std::optional<double> mooney_share{};   // c, 0 to 1; kMooneyRivlin only
  std::optional<double> fung_exponent{};  // b, above 0; kFung only
  std::vector<double> ogden_exponents{};  // alpha, one to kMaxOgdenTerms; kOgden only
  std::vector<double> ogden_shares{};     // w, one an exponent; a single exponent needs none

  bool operator==(const StrainEnergyLaw&) const = default;
};

inline constexpr std::size_t kMaxOgdenTerms = 3;

/// As scenes and material files name them.
inline constexpr std::array<std::pair<std::string_view, StrainEnergyKind>, 5> kLawNames{
    {{"neo-hooke", StrainEnergyKind::kNeoHooke},
     {"mooney-rivlin", StrainEnergyKind::kMooneyRivlin},
     {"ogden", StrainEnergyKind::kOgden},
     {"fung", StrainEnergyKind::kFung},
     {"linear", StrainEnergyKind::kLinear}}};
[[nodiscard]] std::string_view law_name(StrainEnergyKind kind);

/// ", mooney_share = 0.2": the parameters that are given, as TOML.
[[nodiscard]] std::string parameters_text(const StrainEnergyLaw& law);

/// "mooney-rivlin, mooney_share = 0.2": the law and its parameters.
[[nodiscard]] std::string law_text(const StrainEnergyLaw& law);

/// Returns what is wrong with the parameters; empty: nothing.
[[nodiscard]] std::string find_fault(const StrainEnergyLaw& law);

}  // namespace sprung
