#pragma once
#include "core/law/brick_law.h"

namespace sprung {

/// What a solid does when it is stretched along one axis and its sides are free.
struct UniaxialResponse {
  double sideways = 1;  // stretch of the two other axes, current over rest length
  double stress = 0;    // nominal: force over the area at rest, Pa
};

/// One brick of a spring model (not kFem), its sides free to move as a whole: stretch s along x, sideways stretch
/// t(s) such that the force on the sides is zero, by Newton's method. Springs are linear in their stretch, lengths are
/// true lengths, so this is a hyperelastic law of its own, which is not one of the textbooks'. NaN where no t is found.
[[nodiscard]] UniaxialResponse brick_uniaxial(Model model, const Material& material, double stretch);

/// St. Venant-Kirchhoff, W = lambda/2 tr(e)^2 + G e:e with Green's strain e: here stress = E s (s^2 - 1) / 2 and
/// t^2 = 1 - nu (s^2 - 1); below s = 1/sqrt(3) it softens without limit. t is NaN beyond s^2 = 1 + 1/nu.
[[nodiscard]] UniaxialResponse st_venant_kirchhoff_uniaxial(const Material& material, double stretch);

/// The compressible neo-Hookean solid that the reference solutions use: W = G/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2, with
/// J = s t^2, I1 = s^2 + 2 t^2, K = E / (3 (1 - 2 nu)). Principal nominal stresses, of the stretches s_i:
/// P_i = G J^(-2/3) (s_i - I1 / (3 s_i)) + K (J - 1) J / s_i; t makes P_2 zero, by Newton's method.
[[nodiscard]] UniaxialResponse neo_hookean_uniaxial(const Material& material, double stretch);

}  // namespace sprung
