#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/law/brick_law.h"

namespace sprung {

/// An elastic material of density 1 kg/m3 without damping; E in Pa.
[[nodiscard]] Material light_material(double young, double poisson);

/// The state of a solid stretched along one axis, sides free.
struct UniaxialResponse {
  double sideways = 1;  // stretch of the two other axes (length over rest length)
  double stress = 0;    // nominal: force over the area at rest, Pa
};

/// One brick at the stretch s along x. The sideways stretch t(s) at which the force on the sides vanishes is found by
/// Newton's method. Springs are linear in their true stretch, so they have a hyperelastic law of their own. NaN if no t
/// is found.
[[nodiscard]] UniaxialResponse brick_uniaxial(Model model, const Material& material, double stretch);

/// St. Venant-Kirchhoff, W = lambda/2 tr(e)^2 + G e:e with Green's strain e: here stress = E s (s^2 - 1) / 2 and
/// t^2 = 1 - nu (s^2 - 1); it softens below s = 1/sqrt(3). t is NaN beyond s^2 = 1 + 1/nu.
[[nodiscard]] UniaxialResponse st_venant_kirchhoff_uniaxial(const Material& material, double stretch);

/// The compressible neo-Hookean solid of the reference solutions: W = G/2 (J^(-2/3) I1 - 3) + K/2 (J - 1)^2, with
/// J = s t^2, I1 = s^2 + 2 t^2, K = E / (3 (1 - 2 nu)). Principal nominal stresses, of the stretches s_i:
/// P_i = G J^(-2/3) (s_i - I1 / (3 s_i)) + K (J - 1) J / s_i; t makes P_2 zero, by Newton's method.
[[nodiscard]] UniaxialResponse neo_hookean_uniaxial(const Material& material, double stretch);

struct UniaxialLaw {
  std::string name{};
  std::optional<Model> model{};  // none: a textbook law
  std::function<UniaxialResponse(double stretch)> response{};
};

/// The laws of one brick of these models, and the two textbook laws. Throws on evaluation, not here, if a model does
/// not support the material.
[[nodiscard]] std::vector<UniaxialLaw> uniaxial_laws(std::span<const Model> models, const Material& material);

/// Tip deflection (small) of a clamped beam of 4 n x n x n bricks (n = `across`) under its own weight, over
/// rho g L^4 / (8 E I) of beam theory without shear. Locking shows as a drop towards nu = 1/2.
[[nodiscard]] double cantilever_deflection(Model model, double poisson, int across);

struct DeflectionAt {
  double poisson;
  double deflection;  // as in cantilever_deflection()
};

/// The same from converged quadratic finite elements (CalculiX 2.20, C3D20R), by increasing Poisson's ratio.
[[nodiscard]] std::span<const DeflectionAt> reference_deflections();

}  // namespace sprung
