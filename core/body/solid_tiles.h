#pragma once
#include "core/body/body.h"
#include "core/body/brick_tiles.h"

namespace sprung {

/// The law of a body's full brick.
[[nodiscard]] SolidLaw solid_law(const Material& material, double h);

/// The tiles of a body with model kCalibrated. Cost: linear in the bricks.
[[nodiscard]] BrickTiles make_solid_tiles(const Body& body);

/// The second derivatives of the energy of bricks `first` to `first` + kPackPadding - 1 at their current positions, see
/// SolidMatrices; zero for rows beyond the last brick.
void solid_matrices(const Body& body, int first, double* matrices, const SpringKernel& kernel = best_spring_kernel());

}  // namespace sprung
