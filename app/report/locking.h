#pragma once
#include <span>

#include "core/law/brick_law.h"

namespace sprung {

/// Small tip deflection of a clamped beam, 4 n x n x n bricks and slender 4 to 1, under its own weight, over the
/// deflection `rho g L^4 / (8 E I)` that beam theory gives without shear. Locking shows as a drop towards nu = 1/2.
[[nodiscard]] double cantilever_deflection(Model model, double poisson, int across);

struct DeflectionAt {
  double poisson;
  double deflection;  // as cantilever_deflection measures it
};

/// The same from converged quadratic finite elements (CalculiX 2.20, C3D20R), ordered by Poisson's ratio.
[[nodiscard]] std::span<const DeflectionAt> reference_deflections();

}  // namespace sprung
