#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "core/body/gathered_bricks.h"
#include "core/body/kernel/tile_kernel.h"
#include "core/bricks/brick_grid.h"

namespace sprung {

/// Stiffness of the springs in the bricks' faces, in multiples of a full brick's: the bricks on both sides of a face
/// add up, and the face is assigned to one of them. Face a is normal to axis a; two bricks share it if they have all
/// four of its nodes in common.
struct FaceShares {
  std::array<std::vector<double>, 3> low;   // of each brick's face on the low side
  std::array<std::vector<double>, 3> high;  // on the high side; 0 if it is assigned to the brick behind it
};

/// `shares` per brick: its stiffness in multiples of a full brick's. Cost: linear in the bricks, except for a search
/// within a row.
[[nodiscard]] FaceShares share_faces(const BrickGrid& grid, const std::vector<double>& shares);

/// Sets of these bricks that share no cell and whose nodes share no lattice point, as rows of the grid, ascending. Most
/// grids are a single layer; if parts of a body pass through the same cells, there are several. Every brick is in one.
/// Cost: linear in the bricks.
[[nodiscard]] std::vector<std::vector<int>> layers_of(const BrickGrid& grid, const std::vector<int>& bricks);

/// All rows of the grid.
[[nodiscard]] std::vector<int> all_bricks(const BrickGrid& grid);

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

/// A body's bricks cut into tiles whose nodes stay in a core's cache while they are computed. The tiles and the order
/// of every sum depend on the bricks alone, not on the number of threads.
struct BrickTiles {
  std::vector<BrickTile> tiles;
  std::vector<SharedNodes> shared;
  std::vector<SharedPart> parts;
  std::size_t shared_size = 0;  // doubles
  GatheredBricks gathered;
};

/// Tiles for the bricks in `tiled`, ascending; nodes of others are shared ones without parts. `faces`: for springs
/// only, else empty. Several bricks and nodes may coincide. Cost: linear in the boxes around the tiles.
[[nodiscard]] BrickTiles make_brick_tiles(const BrickGrid& grid, const std::vector<int>& tiled,
                                          const PackNumbers& numbers, const FaceShares& faces);

/// Tiles for springs. `stiffness_scale` per brick: its stiffness in multiples of a full brick's, above 0.
[[nodiscard]] BrickTiles make_spring_tiles(const BrickGrid& grid, const std::vector<double>& stiffness_scale);

}  // namespace sprung
