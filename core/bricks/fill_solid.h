#pragma once
#include "core/bricks/pieces.h"

namespace sprung {

/// A solid filled with bricks that are ready for a body, and a report.
struct FilledSolid {
  BrickGrid grid;
  PieceReport pieces;
  int slivers = 0;  // nearly empty bricks merged into others
};

/// kFill: for laws that scale a whole brick's; kMoments: for laws that know where the solid of a brick lies.
enum class BricksFor { kFill, kMoments };

/// voxelize(), split_pieces() and absorb_slivers(); for kMoments absorb_loose_bricks() too. `brick_size`: in units of
/// the solid. Throws like voxelize().
[[nodiscard]] FilledSolid fill_solid(const Solid& solid, double brick_size, BricksFor law = BricksFor::kFill);

}  // namespace sprung
