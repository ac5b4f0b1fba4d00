#pragma once
#include <cstddef>

namespace sprung {

/// Places side by side in a plane of a tile.
struct Run {
  int place;  // of the first
  int count;
  int first;  // of bricks: in `packs`; of faces: in `shares`; of shared nodes: in the shared forces
  int node;   // runs of nodes: the body's node that comes first; the others follow it
};

/// The kinds of runs of a plane of nodes. All but those of nodes are a multiple of kPackPadding long and may hold
/// places that are none of theirs.
enum RunKind : int {
  kNodes,        // all
  kOwnNodes,     // no other tile pulls at them
  kSharedNodes,  // other tiles do
  kPlaces,       // all that hold nodes
  kBricks,       // between this plane and the next
  kXyFaces,      // those that are no brick's low face: the body ends there
  kZxFaces,
  kYzFaces,
  kRunKinds
};

/// More than any vector of numbers that is computed at once.
inline constexpr int kPackPadding = 8;

/// A box of lattice cells with some of a body's bricks; each brick is in one tile. Its planes of nodes lie one row
/// after the other along x in `pitch` places each, so the places next to one in x, y and z are place + 1, place + pitch
/// and the same one in the next plane, and runs go on from row to row. Plain arrays, for code that is compiled once for
/// each instruction set.
///
/// `shares` says of how many full bricks a run's bricks or faces are, 0 at the places that are none. Those of bricks
/// lie pack by pack of kPackPadding places: their own shares, then those of their low xy, zx and yz faces, which a
/// face's two bricks add up to; `packs` says where each begins, and those that are alike, as inside a body, lie there
/// once. Those of faces are one list.
struct TileView {
  int pitch;
  int planes;  // of nodes
  const Run* runs;
  const int* first_run;  // of kind k in plane p: first_run[p * kRunKinds + k], up to the next
  const double* shares;
  const int* packs;
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

/// A tile's planes of nodes in the scratch: kPlaneArrays arrays each, an odd number of cache lines long, for arrays
/// that lie powers of two apart would fight for the same places in the cache. Before kFirstPlace no node lies.
inline constexpr int kFirstPlace = 8;
inline constexpr int kMostPlaces = 760;  // of a plane, with room for a pack, a row and a place behind the last brick
inline constexpr int kArraySize = 776;
inline constexpr int kPlaneArrays = 23;
inline constexpr int kPlaneSize = kPlaneArrays * kArraySize;
static_assert(kArraySize % 16 == 8 && kArraySize >= kFirstPlace + kMostPlaces + kPackPadding);

/// Doubles of scratch for a tile.
inline constexpr int kScratchSize = 2 * kPlaneSize;

}  // namespace sprung
