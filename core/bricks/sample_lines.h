#pragma once
#include <vector>

#include "core/bricks/column_caster.h"

namespace sprung {

/// Samples of a cell along each axis: at (i + 1/2) / 8.
inline constexpr int kSamplesAlong = 8;

/// A stretch inside the surface of a line through samples.
struct InsideRun {
  int u;        // sample numbers along the two axes that follow the line's own one: its place
  int v;        //
  double from;  // cells
  double to;
};

/// What is inside the surface of the lines through all samples of the box along `axis`, by place and from low to high.
/// Inside is where the surface winds around a point at all. Ties are broken as in cast_columns(). A line that does not
/// leave the surface as often as it enters says nothing.
[[nodiscard]] std::vector<InsideRun> inside_runs(const CellSurface& surface, int axis);

}  // namespace sprung
