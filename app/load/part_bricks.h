#pragma once
#include <vector>

#include "core/simulation/body_source.h"

namespace sprung {

/// The sizes of the bricks (m) of a part's grids, finest first, and why.
struct PartBricks {
  std::vector<double> sizes;
  double thickness = 0;    // m, that 95 % of the surface exceeds; 0: unknown
  bool is_chosen = false;  // and not asked for: the finest may be left out where it would take too long
};

/// Grids of some `most` bricks at most and of about 1.4 and 2 times their size, so that an error can be stated; each
/// near its goal such that the flat faces across the axes lie between bricks, as well as any size can do it: walls are
/// then whole numbers of bricks. The finest has at most kBricksAcross bricks across thin walls.
[[nodiscard]] PartBricks choose_part_bricks(const LoadedBody& loaded, double most);

/// The same for a finest size (m) that is given.
[[nodiscard]] PartBricks part_bricks_from(const LoadedBody& loaded, double finest);

inline constexpr double kBricksAcross = 12;

}  // namespace sprung
