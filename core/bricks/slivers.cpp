#include "core/bricks/slivers.h"

#include <algorithm>
#include <array>

#include "core/bricks/neighbours.h"

namespace sprung {
namespace {

constexpr double kStrongFill = 0.5;

using Neighbours = std::array<int, 6>;

/// The fullest neighbour, or -1 where none is strong enough.
int strongest(const BrickGrid& grid, const Neighbours& neighbours) {
  int best = -1;
  double best_fill = kStrongFill;
  for (const int neighbour : neighbours) {
    if (neighbour < 0 || grid.fill[static_cast<std::size_t>(neighbour)] < best_fill) continue;
    best = neighbour;
    best_fill = grid.fill[static_cast<std::size_t>(neighbour)];
  }
  return best;
}

}  // namespace

int absorb_slivers(BrickGrid& grid, double least_fill) {
  const CellIndex index(grid);
  const std::size_t count = grid.cells.size();
  std::vector<Neighbours> neighbours(count);
  std::vector<int> receiver(count);
  for (std::size_t i = 0; i < count; ++i) {
    neighbours[i] = face_neighbours(grid, index, i);
    receiver[i] = strongest(grid, neighbours[i]);
  }
  std::vector<bool> gone(count, false);
  std::vector<double> fill = grid.fill;
  for (std::size_t i = 0; i < count; ++i) {
    if (grid.fill[i] >= least_fill || receiver[i] < 0) continue;
    const bool is_needed = std::any_of(neighbours[i].begin(), neighbours[i].end(), [&](int other) {
      return other >= 0 && grid.fill[static_cast<std::size_t>(other)] < kStrongFill &&
             receiver[static_cast<std::size_t>(other)] < 0;
    });
    if (is_needed) continue;
    gone[i] = true;
    fill[static_cast<std::size_t>(receiver[i])] += grid.fill[i];
  }
  grid.fill = std::move(fill);
  remove_bricks(grid, gone, receiver);
  return static_cast<int>(std::count(gone.begin(), gone.end(), true));
}

}  // namespace sprung
