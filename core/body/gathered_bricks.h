#pragma once
#include <array>
#include <functional>
#include <vector>

#include "core/body/kernel/tile_kernel.h"
#include "core/bricks/brick_grid.h"

namespace sprung {

/// The kernel's parameters of kPackPadding bricks side by side (-1: none), see TileView::shares.
using PackNumbers = std::function<std::vector<double>(const std::array<int, kPackPadding>& bricks)>;

/// Bricks outside all tiles, see GatheredView.
struct GatheredBricks {
  std::vector<double> numbers;
  std::vector<int> packs;
  std::vector<int> corners;
  std::vector<int> first_force;
  std::vector<int> force_places;

  /// `forces`: kGatheredForces a pack.
  [[nodiscard]] GatheredView view(double* forces) const {
    if (packs.empty()) return {};
    return {numbers.data(), packs.data(), corners.data(), first_force.data(), force_places.data(), forces};
  }
};

/// Each group of bricks in packs of its own. Cost: linear in the bricks and in the nodes of the grid.
[[nodiscard]] GatheredBricks gather_bricks(const BrickGrid& grid, const std::vector<std::vector<int>>& groups,
                                           const PackNumbers& numbers);

}  // namespace sprung
