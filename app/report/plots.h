#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/report/svg_plot.h"
#include "app/validate/check.h"
#include "app/validate/node_errors.h"

namespace sprung {

/// Error of each model over the bricks across the beam, log-log: nu = 0.3 large, 0 and 0.49 beside it. Takes the checks
/// of one quantity of the linear cantilever; errors that are not finite or beyond 100 % (bricks that hold nothing) are
/// left out. Those below 0.02 %, which is what the reference itself is good for, are drawn there.
[[nodiscard]] Figure convergence_figure(const std::vector<Check>& checks);

/// Errors of the deflection (along y) at every node, at its place along x, as the paper's Figure 5 shows them: over the
/// largest known displacement. A panel a model, a colour a grid; lines go through the means of the sections. Takes
/// those of one Poisson's ratio.
[[nodiscard]] Figure node_error_figure(const std::vector<NodeErrors>& errors, double poisson);

/// Towards nu = 1/2: the deflection of the cantilever against the classical hexahedron, which locks, and the volume of
/// a stretched brick, which its springs do not keep. Computes its data; under a second.
[[nodiscard]] Figure incompressibility_figure();

/// Nominal stress over E of a brick stretched from 0.5 to 2 at nu = 0.3, against two textbook laws. Computes its data.
[[nodiscard]] Figure stress_stretch_figure();

/// Writes the figure as an SVG file beside its name and renames it. Throws Error(kFailed).
void write_svg(const Figure& figure, const std::filesystem::path& file);

}  // namespace sprung
