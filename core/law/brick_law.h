#pragma once
#include <span>
#include <string_view>

#include "core/law/material.h"

namespace sprung {

/// The law of a body's bricks. M1 is springs along edges and face diagonals, M2 along edges and inner diagonals.
enum class Model {
  kCalibrated,  // an energy of strain, by the moments of the solid in each brick (default; see solid/solid_brick.h)
  kTensile,     // the paper's M2 with its corrections: exact in stretch and shear
  kM1,          // the paper's M1 with its corrections: exact in stretch and shear
  kM2Plain,     // M2 without corrections: right at nu = 1/4 only
  kM1Plain,     // M1 without corrections: right at nu = 1/4 only
  kFem          // no springs: the trilinear hexahedron, small strains, to compare with (see hexahedron.h)
};

[[nodiscard]] std::string_view model_name(Model model);
/// Returns whether bricks of the model are computed in packs, see SpringSystem.
[[nodiscard]] constexpr bool has_tiles(Model model) { return model != Model::kFem; }
/// Returns whether bodies of the model are mass-spring systems, whose bricks are a BrickLaw each.
[[nodiscard]] constexpr bool has_springs(Model model) { return model != Model::kFem && model != Model::kCalibrated; }
/// Throws Error(kUsage) with the nearest name.
[[nodiscard]] Model model_from_name(std::string_view name);

/// The constants of one full brick, all in N/m. A brick is 12 edges, 12 face diagonals and 4 inner diagonals; a
/// stretch is a current length minus the rest length, s_e that of edge e along axis i. With
///   e_i  = mean of the four s_e along i                               mean stretch
///   a_i  = |mean of the four edge vectors along i| - h                stretch of the mean axis
/// its energy is
///   W = 1/2 edge   sum_edges s^2 + 1/2 face sum_faces s^2 + 1/2 inner sum_inner s^2
///     + 1/2 sum_ij axial_ij e_i e_j                 axial_ii = axial_self, axial_ij = axial_cross
///     + 1/2 axes (a_x + a_y + a_z)^2
/// Every term is a set of tensions along edges, mean axes and diagonals, so momentum is conserved whatever the
/// constants. To first order, and in every homogeneous deformation, a_i = e_i. Only a negative remainder of the
/// correction in (e_x + e_y + e_z)^2 (at low nu) acts on the mean axes: a brick that folds like an hourglass lengthens
/// its edges, but not the mean of their vectors, and on edges that part would pull it apart without end.
struct BrickLaw {
  double edge = 0;
  double face = 0;
  double inner = 0;
  double axial_self = 0;
  double axial_cross = 0;
  double axes = 0;  // never positive
};

/// Every model by name, in the order above.
[[nodiscard]] std::span<const std::string_view> model_names();

/// The law of a brick of side h (m). Throws Error(kBadInput) if the model cannot represent the material (M2 needs -1/4
/// < nu, M1 0 <= nu: an edge spring must not push; kCalibrated -1/2 <= nu). A model without springs gets an empty law.
/// Source of kTensile and kM1 (the paper): Baudet, Beuve, Jaillet, Shariat, Zara, "Integrating Tensile Parameters in
/// Hexahedral Mass-Spring System for Simulation", WSCG 2009: inner = 3 E h / (8 (1+nu)), edge = E h (4 nu + 1) / (8
/// (1+nu)), and their correction forces as the potential axial = h (lambda J + 2 G I) - 4 edge I - (4/3) inner J - 2
/// face (I + J). M1: face = G h / 2, edge = nu G h.
[[nodiscard]] BrickLaw brick_law(Model model, const Material& material, double h);

}  // namespace sprung
