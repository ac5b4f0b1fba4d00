#pragma once
#include "core/bricks/pieces.h"

namespace sprung {

/// A solid filled with bricks that are ready for a body, and what was done to them.
struct FilledSolid {
  BrickGrid grid;
  PieceReport pieces;
  int slivers = 0;  // nearly empty bricks that are a part of others now
};

/// voxelize(), split_pieces() and absorb_slivers(). `brick_size`: in units of the solid. Throws like voxelize().
[[nodiscard]] FilledSolid fill_solid(const Solid& solid, double brick_size);

}  // namespace sprung
