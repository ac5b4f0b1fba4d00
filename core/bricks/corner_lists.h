#pragma once
#include <array>
#include <vector>

namespace sprung {

/// Which corners of bricks meet at each node, in the order of the bricks: those of node i are corners[first[i]] ..
/// corners[first[i + 1] - 1], a corner counted as 8 brick + corner.
struct CornerLists {
  std::vector<int> first;
  std::vector<int> corners;
};

/// `bricks` by their nodes, corner by corner.
[[nodiscard]] CornerLists list_corners(const std::vector<std::array<int, 8>>& bricks, int node_count);

}  // namespace sprung
