#pragma once
#include <span>
#include <string_view>

#include "core/law/material.h"

namespace sprung {

/// How a brick's springs are laid out and calibrated. M1 is edges and face diagonals, M2 edges and inner diagonals.
enum class Model {
  kCalibrated,  // edges, face and inner diagonals; exact in stretch, shear, torsion and bending (default)
  kTensile,     // the paper's M2 with its corrections: exact in stretch and shear
  kM1,          // the paper's M1 with its corrections: exact in stretch and shear
  kM2Plain,     // M2 without corrections: right at nu = 1/4 only
  kM1Plain,     // M1 without corrections: right at nu = 1/4 only
  kFem          // no springs: the trilinear hexahedron, small strains, to compare with (see hexahedron.h)
};

[[nodiscard]] std::string_view model_name(Model model);
/// Throws Error(kUsage) with the nearest name.
[[nodiscard]] Model model_from_name(std::string_view name);

/// The constants of one full brick, all in N/m. A brick is 12 edges, 12 face diagonals and 4 inner diagonals; a
/// stretch is a current length minus the rest length, s_e that of edge e along axis i. With
///   e_i  = mean of the four s_e along i                               mean stretch
///   b_ij = mean of the four s_e along i, signed by their side in j    bending stretch, j != i
/// its energy is
///   W = 1/2 edge   sum_edges s^2 + 1/2 face sum_faces s^2 + 1/2 inner sum_inner s^2
///     + 1/2 sum_ij axial_ij e_i e_j                 axial_ii = axial_self, axial_ij = axial_cross
///     + 1/2 sum over the gradient direction j of (b_ij, b_kj) bending (b_ij, b_kj)^T      i, k != j
/// Every term is a set of tensions along edges and diagonals, so momentum is conserved whatever the constants.
struct BrickLaw {
  double edge = 0;
  double face = 0;
  double inner = 0;
  double axial_self = 0;
  double axial_cross = 0;
  double bending_self = 0;
  double bending_cross = 0;
  double guard = 0;          // energy of the volume guard, J: W = guard/2 (guard_ratio - V)^2 where V < guard_ratio
  double guard_ratio = 0.3;  // of the rest volume
};

/// Every model by name, in the order above.
[[nodiscard]] std::span<const std::string_view> model_names();

/// The law of a brick of side h (m). Throws Error(kBadInput) where the model cannot represent the material (M2 needs
/// -1/4 < nu, M1 0 <= nu: an edge spring must not push). kFem has no springs and gets an empty law.
/// Source of kTensile and kM1 (the paper): Baudet, Beuve, Jaillet, Shariat, Zara, "Integrating Tensile Parameters in
/// Hexahedral Mass-Spring System for Simulation", WSCG 2009: inner = 3 E h / (8 (1+nu)), edge = E h (4 nu + 1) / (8
/// (1+nu)), and their correction forces as the potential axial = h (lambda J + 2 G I) - 4 edge I - (4/3) inner J - 2
/// face (I + J). M1: face = G h / 2, edge = nu G h. kCalibrated: torsion gives face = G h / 6, shear then inner = G h /
/// 2, edge = 0, and two bending experiments give bending = (h/3) E/(1-nu^2) [[1, nu], [nu, 1]] - 2 face [[1, 1], [1,
/// 1]].
[[nodiscard]] BrickLaw brick_law(Model model, const Material& material, double h);

}  // namespace sprung
