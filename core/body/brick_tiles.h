#pragma once
#include <cstddef>
#include <vector>

#include "core/body/kernel/tile.h"
#include "core/bricks/brick_grid.h"

namespace sprung {

/// A part of a body's bricks for one thread at a time, see TileView.
struct BrickTile {
  int pitch = 0;
  int planes = 0;
  std::vector<Run> runs;
  std::vector<int> first_run;
  std::vector<double> shares;
  std::vector<int> packs;
  std::size_t shared_offset = 0;  // of this tile's part of the shared forces

  [[nodiscard]] TileView view() const {
    return {pitch, planes, runs.data(), first_run.data(), shares.data(), packs.data()};
  }
};

/// A body's bricks cut into tiles whose nodes stay in a core's cache while they are computed. The cut depends on the
/// bricks alone, and so does the order of every sum: not on the number of threads.
struct BrickTiles {
  std::vector<BrickTile> tiles;
  std::vector<SharedNodes> shared;
  std::vector<SharedPart> parts;
  std::size_t shared_size = 0;  // doubles
};

/// `stiffness_scale` per brick: of how many full bricks it has the stiffness, above 0. Bricks and nodes may lie at the
/// same place several times. Cost: linear in the boxes around the tiles.
[[nodiscard]] BrickTiles make_brick_tiles(const BrickGrid& grid, const std::vector<double>& stiffness_scale);

}  // namespace sprung
