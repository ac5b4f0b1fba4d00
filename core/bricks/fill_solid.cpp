#include "core/bricks/fill_solid.h"

#include "core/bricks/slivers.h"
#include "core/bricks/voxelize.h"

namespace sprung {

FilledSolid fill_solid(const Solid& solid, double brick_size, BricksFor law) {
  FilledSolid filled{.grid = voxelize(solid, brick_size), .pieces = {}};
  filled.pieces = split_pieces(solid, filled.grid);
  filled.slivers = absorb_slivers(filled.grid);
  if (law == BricksFor::kMoments) filled.slivers += absorb_loose_bricks(filled.grid);
  filled.grid.moments = solid_moments(filled.grid);
  return filled;
}

}  // namespace sprung
