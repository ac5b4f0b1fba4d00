#pragma once
#include <vector>

#include "core/bricks/piece_list.h"
#include "core/disjoint_sets.h"

namespace sprung {

/// How the pieces of a solid hang together.
struct PieceLinks {
  DisjointSets corners;         // of 8 piece + corner: those that are one node
  std::vector<int> same_brick;  // by piece: the first piece of its cell that it makes one brick with
  int attached = 0;             // links too thin to be seen
};

/// Pieces share the corners of a face that solid runs through, and those of an edge or a corner that a straight line
/// inside runs past. A solid is one piece: what the samples leave without a link is joined to its nearest neighbour.
[[nodiscard]] PieceLinks link_pieces(const PieceList& list);

}  // namespace sprung
