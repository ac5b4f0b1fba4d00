#pragma once
#include <Eigen/Core>
#include <array>

#include "core/law/material.h"

namespace sprung {

/// How a rectangle's springs are calibrated.
enum class RectangleModel {
  kPlain,      // the paper's six springs alone: right at nu = 1/3 only
  kCorrected,  // with the paper's correction: exact in stretch and shear
  kCalibrated  // exact in bending too
};

/// The constants (N/m) of a rectangle l x h of unit thickness in plane stress. Its springs are two edges along each
/// axis i and two diagonals; with s_low, s_high the stretches of the edges along i on either side,
///   e_i = (s_low + s_high) / 2     mean stretch
///   b_i = (s_high - s_low) / 2     bending stretch
/// its energy is
///   W = 1/2 sum_i edge_i (s_low^2 + s_high^2) + 1/2 diagonal (sum of both squared diagonal stretches)
///     + 1/2 e^T axial e + 1/2 sum_i bending_i b_i^2         axial_ii = axial_self[i], axial_01 = axial_cross
/// It has no guard: an inverted rectangle stays inverted.
struct RectangleLaw {
  std::array<double, 2> sides{};  // l, h at rest, m
  std::array<double, 2> edge{};
  double diagonal = 0;
  std::array<double, 2> axial_self{};
  double axial_cross = 0;
  std::array<double, 2> bending{};
};

/// The law of a rectangle with the given sides (m). With d^2 = l^2 + h^2:
/// Springs (the paper, see brick_law.h): shear gives diagonal = E d^2 / (4 l h (1+nu)), elongation edge_l = E (h^2 (3
/// nu + 2) - l^2) / (4 l h (1+nu)), edge_h with l and h exchanged. Throws Error(kBadInput) if one of them would push
/// (kPlain, kCorrected: a rectangle too slender for nu).
/// Stretch: a uniform strain costs l h / 2 (stress : strain); in mean stretches that is 1/2 e^T D e with D_ll = E h /
/// (l (1-nu^2)), D_hh = E l / (h (1-nu^2)), D_lh = E nu / (1-nu^2). The springs give A_ll = 2 edge_l + 2 diagonal
/// l^2/d^2, A_hh likewise, A_lh = 2 diagonal l h/d^2. So axial = D - A: the paper's F_perp of every strain, as one
/// potential. Bending: u_x = c x y costs 1/2 E c^2 (integral of y^2 over the rectangle) = E c^2 l h^3 / 24 where the
/// lateral stress is free, and b_l = c l h / 2, so b_l meets E h / (3 l); the diagonals keep their lengths, the edges
/// give 2 edge_l. So bending_l = E h / (3 l) - 2 edge_l, bending_h = E l / (3 h) - 2 edge_h. kCalibrated sets edge = 0
/// and lets the corrections do all (the energy is the same for any edge): any sides, any nu.
[[nodiscard]] RectangleLaw rectangle_law(RectangleModel model, const Material& material,
                                         const std::array<double, 2>& sides);

/// x y of the four corners; bit 0 of a corner is its side in x, bit 1 its side in y.
using RectangleVector = Eigen::Matrix<double, 8, 1>;
using RectangleMatrix = Eigen::Matrix<double, 8, 8>;

/// Elastic energy (J) with corners at x (m), its negative gradient (N) and its second derivative (N/m, symmetric), all
/// for a thickness of 1 m and any deformation that leaves no spring without length.
[[nodiscard]] double rectangle_energy(const RectangleLaw& law, const RectangleVector& x);
[[nodiscard]] RectangleVector rectangle_forces(const RectangleLaw& law, const RectangleVector& x);
[[nodiscard]] RectangleMatrix rectangle_hessian(const RectangleLaw& law, const RectangleVector& x);

/// The corners of a rectangle at rest, its low corner at the origin, m.
[[nodiscard]] RectangleVector rest_corners(const RectangleLaw& law);

}  // namespace sprung
