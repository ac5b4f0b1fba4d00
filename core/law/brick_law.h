#pragma once
#include <span>
#include <string_view>

#include "core/law/material.h"

namespace sprung {

/// The law of a body's bricks. M1 is springs along edges and face diagonals, M2 along edges and inner diagonals.
enum class Model {
  kCalibrated,  // neo-Hookean, by the moments of the solid in each brick (default; see neo_hooke/solid_brick.h)
  kSprings,     // edges, face and inner diagonals: full bricks are exact in stretch, shear, torsion and bending
  kTensile,     // the paper's M2 with its corrections: exact in stretch and shear
  kM1,          // the paper's M1 with its corrections: exact in stretch and shear
  kM2Plain,     // M2 without corrections: right at nu = 1/4 only
  kM1Plain,     // M1 without corrections: right at nu = 1/4 only
  kFem          // no springs: the trilinear hexahedron, small strains, to compare with (see hexahedron.h)
};

[[nodiscard]] std::string_view model_name(Model model);
/// Whether bricks of the model are computed in packs, see SpringSystem.
[[nodiscard]] constexpr bool has_tiles(Model model) { return model != Model::kFem; }
/// Whether bodies of the model are mass-spring systems, whose bricks are a BrickLaw each.
[[nodiscard]] constexpr bool has_springs(Model model) { return model != Model::kFem && model != Model::kCalibrated; }
/// Throws Error(kUsage) with the nearest name.
[[nodiscard]] Model model_from_name(std::string_view name);

/// The constants of one full brick, all in N/m. A brick is 12 edges, 12 face diagonals and 4 inner diagonals; a
/// stretch is a current length minus the rest length, s_e that of edge e along axis i. With
///   e_i  = mean of the four s_e along i                               mean stretch
///   a_i  = |mean of the four edge vectors along i| - h                stretch of the mean axis
///   b_ij = mean of the four s_e along i, signed by their side in j    bending stretch, j != i
/// its energy is
///   W = 1/2 edge   sum_edges s^2 + 1/2 face sum_faces s^2 + 1/2 inner sum_inner s^2
///     + 1/2 sum_ij axial_ij e_i e_j                 axial_ii = axial_self, axial_ij = axial_cross
///     + 1/2 axes (a_x + a_y + a_z)^2
///     + 1/2 sum over the gradient direction j of (b_ij, b_kj) bending (b_ij, b_kj)^T      i, k != j
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
  double bending_self = 0;
  double bending_cross = 0;
  double guard = 0;          // energy of the volume guard, J: W = guard/2 (guard_ratio - V)^2 where V < guard_ratio
  double guard_ratio = 0.3;  // of the rest volume
};

/// Every model by name, in the order above.
[[nodiscard]] std::span<const std::string_view> model_names();

/// The law of a brick of side h (m). Throws Error(kBadInput) if the model cannot represent the material (M2 needs -1/4
/// < nu, M1 0 <= nu: an edge spring must not push; kCalibrated -1/2 <= nu). A model without springs gets an empty law.
/// Source of kTensile and kM1 (the paper): Baudet, Beuve, Jaillet, Shariat, Zara, "Integrating Tensile Parameters in
/// Hexahedral Mass-Spring System for Simulation", WSCG 2009: inner = 3 E h / (8 (1+nu)), edge = E h (4 nu + 1) / (8
/// (1+nu)), and their correction forces as the potential axial = h (lambda J + 2 G I) - 4 edge I - (4/3) inner J - 2
/// face (I + J). M1: face = G h / 2, edge = nu G h. kSprings: torsion gives face = G h / 6, shear then inner = 3/4
/// (G h - 2 face), edge = 0, and two bending experiments give bending = (h/3) E/(1-nu^2) [[1, nu], [nu, 1]] - 2 face
/// [[1, 1], [1, 1]]. Where nu < 0 that would be negative for bending in one sense about both axes, and a brick far from
/// rest could pull itself apart: there face = E h / (12 (1-nu)), the most that leaves it at zero, and the twist of a
/// brick is (1+nu) / (1-nu) of what it should be; stretch, shear and bending are exact still.
///
/// What is left free. Of a brick's 24 modes 6 are rigid, 6 uniform strain, 6 bending (u_x = xy and the like), 3 are u_x
/// = a yz, u_y = b zx, u_z = c xy, and 3 xyz. Uniform strain and cylindrical and anticlastic bending fix theirs. (a, b,
/// c) has two constants, for a + b + c = 0 (twist about an axis) and a = b = c; a plate's twist (-1, -1, 1) ties them
/// together and leaves one. It could make the torsion of a bar of one brick exact, whose section warps between the
/// nodes (18 % too stiff now), by a coupling of the twists of the three pairs of faces. That would improve bars two and
/// four across only from 18 to 13 % and from 5 to 4 %, make the twist of a brick within a thick body 16 % too soft, and
/// the frequencies of torsion, too low already because masses at the corners have too much rotary inertia, lower still
/// (38 to 43 %, 12 to 13 %). So it is not done. The xyz modes have their stiffness and, by the inner diagonals, a
/// coupling with shear: neighbours cancel it, the eight corners of a body do not. A free cube of 1, 2, 4 bricks a side
/// under shear tractions deforms by 3.00, 1.08, 1.01 of what it should. With the xyz modes of the trilinear hexahedron
/// it would be exact, but the L-bracket at a pitch of 0.1, 0.05, 0.025 m falls from 0.998, 0.921, 0.957 to 0.858,
/// 0.899, 0.951. That error is the singularity of the re-entrant edge: it falls with h^1.1 (twice 0.54, the exponent of
/// the displacements there), and no constant of the brick moves it. The bricks at the edge at 0.8 of their stiffness
/// bring both finer pitches within 1 %, but no longer reproduce uniform strain, and a staircase in a curved surface is
/// no edge. tests/core/law/brick_limits_test.cpp measures the statics of this.
[[nodiscard]] BrickLaw brick_law(Model model, const Material& material, double h);

}  // namespace sprung
