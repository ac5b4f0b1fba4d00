#pragma once
#include <cstddef>

namespace sprung {

/// Bricks, springs or nodes side by side along x.
struct Run {
  int x;      // where the first is, in the rows of the scratch
  int count;  //
  int first;  // in `shares`; of shared nodes: in the shared forces
  int node;   // runs of nodes: the body's node that comes first
};

/// The kinds of runs, each kept by the row of nodes that it lies in or begins at.
enum RunKind : int {
  kNodes,        // no other tile pulls at them
  kSharedNodes,  // other tiles may
  kXEdges,
  kYEdges,
  kZEdges,
  kBricks,
  kXyFaces,  // those that are no brick's low face: the body ends there
  kZxFaces,
  kYzFaces,
  kRunKinds
};

/// Runs may be read and written up to that far behind their end.
inline constexpr int kRunPadding = 8;

/// A box of lattice cells with some of a body's bricks; each brick is in one tile. Plain arrays, for code that is
/// compiled once for each instruction set.
///
/// `shares` says of how many full bricks a run's bricks or springs are, each list padded with zeros to a multiple of
/// kRunPadding. For bricks four lists: their own share and those of their low xy, zx and yz faces, which a face's two
/// bricks add up to. For faces and edges one; edges count only the bricks of this tile.
struct TileView {
  int rows;    // of nodes
  int planes;  // of nodes
  const Run* runs;
  const int* first_run;  // of kind k in row y of plane p: first_run[(p * rows + y) * kRunKinds + k], up to the next
  const double* shares;
};

/// What one tile adds to the forces on a run of nodes that other tiles pull at too: x, y and z of the run one after the
/// other.
struct SharedPart {
  int node;  // first
  int count;
  std::size_t offset;  // in the shared forces
};

/// Neighbouring shared nodes and the parts that cover them, in a fixed order.
struct SharedNodes {
  int node;  // first
  int count;
  std::size_t first_part;
  std::size_t last_part;  // one past
};

/// A tile's rows of nodes in the scratch: kRowArrays arrays of kPitch doubles each, an odd number of cache lines, for
/// rows that lie powers of two apart would fight for the same places in the cache.
inline constexpr int kTileWidth = 64;  // bricks along x, at most
inline constexpr int kFirstPlace = 8;  // along x: what is before it belongs to no node
inline constexpr int kPitch = 88;
inline constexpr int kRowArrays = 23;
inline constexpr int kRowSize = kRowArrays * kPitch;
static_assert(kPitch > kFirstPlace + kTileWidth + 1 + kRunPadding && kPitch % 16 == 8);

/// Doubles of scratch for a tile.
[[nodiscard]] constexpr int scratch_size(int rows) { return 2 * rows * kRowSize; }

}  // namespace sprung
