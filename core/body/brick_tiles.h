#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/body/kernel/tile_pass.h"
#include "core/bricks/brick_grid.h"

namespace sprung {

/// How stiff the springs in the bricks' faces are, in full bricks: the bricks on both sides of a face add up, and the
/// face counts for one of them. Face a is the one across axis a; bricks are on two sides of it where they have all four
/// of its nodes in common.
struct FaceShares {
  std::array<std::vector<double>, 3> low;   // of each brick's face on the low side
  std::array<std::vector<double>, 3> high;  // on the high side; 0 where it counts for the brick behind it
};

/// `shares` per brick: of how many full bricks it has the stiffness. Cost: linear in the bricks but for a search in a
/// row of them.
[[nodiscard]] FaceShares share_faces(const BrickGrid& grid, const std::vector<double>& shares);

/// Bricks that share no cell, and whose nodes share no place of the lattice, by their rows in the grid, ascending: most
/// grids are one such layer; where parts of a body pass through the same cells, they fall into several. Every brick is
/// in one. Cost: linear in the bricks.
[[nodiscard]] std::vector<std::vector<int>> layers_of(const BrickGrid& grid);

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

/// What the kernel is told of kPackPadding bricks side by side (-1 where there is none), see TileView::shares.
using PackNumbers = std::function<std::vector<double>(const std::array<int, kPackPadding>& bricks)>;

/// A body's bricks cut into tiles whose nodes stay in a core's cache while they are computed. The cut depends on the
/// bricks alone, and so does the order of every sum: not on the number of threads.
struct BrickTiles {
  std::vector<BrickTile> tiles;
  std::vector<SharedNodes> shared;
  std::vector<SharedPart> parts;
  std::size_t shared_size = 0;  // doubles
};

/// `faces`: of springs only, else empty. Bricks and nodes may lie at the same place several times. Cost: linear in the
/// boxes around the tiles.
[[nodiscard]] BrickTiles make_brick_tiles(const BrickGrid& grid, const PackNumbers& numbers, const FaceShares& faces);

/// Of springs. `stiffness_scale` per brick: of how many full bricks it has the stiffness, above 0.
[[nodiscard]] BrickTiles make_spring_tiles(const BrickGrid& grid, const std::vector<double>& stiffness_scale);

}  // namespace sprung
