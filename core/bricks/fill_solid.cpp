#include "core/bricks/fill_solid.h"

#include "core/bricks/slivers.h"
#include "core/bricks/voxelize.h"

namespace sprung {

FilledSolid fill_solid(const Solid& solid, double brick_size) {
  FilledSolid filled{.grid = voxelize(solid, brick_size), .pieces = {}};
  filled.pieces = split_pieces(solid, filled.grid);
  filled.slivers = absorb_slivers(filled.grid);
  filled.grid.moments = solid_moments(filled.grid);
  return filled;
}

}  // namespace sprung
