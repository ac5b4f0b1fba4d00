#pragma once
#include "core/bricks/brick_grid.h"
#include "core/mesh/solids.h"

namespace sprung {

/// What split_pieces() found.
struct PieceReport {
  int divided = 0;   // cells that hold more than one piece
  int attached = 0;  // pieces whose link to the rest is too thin to be seen, joined to a neighbour all the same
  int dropped = 0;   // bricks of floating specks, gone
  double dropped_volume = 0;  // m^3; the other bricks' fill makes up for it
  int floating = 0;           // larger pieces that hang together with no other
};

/// Gives the pieces of solid that share a cell but do not hang together in it a brick each, and joins bricks only where
/// solid runs from one to the next through their face. What hangs together is found from 8 x 8 x 8 samples a cell that
/// the surface cuts, the lines between them and, where those say nothing, straight lines that meet no triangle: a gap
/// counts however narrow, solid down to about a twentieth of a brick. A piece of less than 4 samples beside a larger
/// one is given to that one's fill. The volume stays. After Nesme, Kry, Jerabkova and Faure, "Preserving topology and
/// elasticity for embedded deformable models" (2009). `grid` is voxelize()'s for the same solid;
/// that of a shell or of loose triangles stays as it is. Deterministic.
PieceReport split_pieces(const Solid& solid, BrickGrid& grid);

}  // namespace sprung
