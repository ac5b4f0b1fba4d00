#pragma once
#include <span>

#include "app/scene/material_library.h"
#include "app/validate/svg_plot.h"

namespace sprung {

/// Nominal stress over stretch of materials, sides free, by their laws at large strains, with what their curves
/// measured. A single material that is not neo-Hookean is compared with a neo-Hookean solid of the same Young's
/// modulus. The stretch is that of the curves, else 0.5 to 2. Throws Error(kBadInput) if a curve cannot be read.
[[nodiscard]] Figure material_figure(std::span<const LibraryMaterial> materials);

}  // namespace sprung
