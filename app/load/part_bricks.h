#pragma once
#include <vector>

#include "core/simulation/body_source.h"

namespace sprung {

/// The sizes of the bricks (m) of a part's grids, finest first, and how they were chosen.
struct PartBricks {
  std::vector<double> sizes;
  double thickness = 0;    // m, exceeded on 95 % of the surface; 0: unknown
  bool is_chosen = false;  // and not requested: the finest may be left out if it would take too long
};

/// A grid of about `most` bricks at most, and grids of about 1.4 and 2 times their size, so that an error can be
/// estimated. Near its target each size is the one at which flat faces normal to the axes coincide best with faces of
/// bricks: walls are then whole numbers of bricks thick. The finest has at most kBricksAcross bricks across thin walls.
[[nodiscard]] PartBricks choose_part_bricks(const LoadedBody& loaded, double most);

/// The same for a finest size (m) that is given.
[[nodiscard]] PartBricks part_bricks_from(const LoadedBody& loaded, double finest);

inline constexpr double kBricksAcross = 12;

}  // namespace sprung
