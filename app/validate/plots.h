#pragma once
#include <vector>

#include "app/validate/check.h"
#include "app/validate/svg_plot.h"

namespace sprung {

/// Error of the tip of the cantilever over the bricks across the beam, for each model, log-log: nu = 0.3 large, 0 and
/// 0.49 next to it. `checks` are those of the cantilever. Errors above 100 % (mechanisms) and failed runs are left out;
/// errors below 0.02 %, the accuracy of the reference, are drawn there.
[[nodiscard]] Figure convergence_figure(const std::vector<Check>& checks);

/// Errors of the deflection (y) at every node at nu = 0.3 over x, as in the paper's Figure 5, relative to the largest
/// known displacement. A plot per model, a colour per grid, lines through the means of the cross sections.
[[nodiscard]] Figure node_error_figure(const std::vector<NodeErrors>& errors);

/// Towards nu = 1/2: locking of the cantilever, and the volume of a stretched brick, which springs do not preserve.
/// Computes its data in less than a second.
[[nodiscard]] Figure incompressibility_figure();

/// Nominal stress over E of a brick stretched from 0.5 to 2 at nu = 0.3, with two textbook laws. Computes its data.
[[nodiscard]] Figure stress_stretch_figure();

}  // namespace sprung
