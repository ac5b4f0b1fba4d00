#include "core/bricks/corner_lists.h"

#include <numeric>

namespace sprung {

CornerLists list_corners(const std::vector<std::array<int, 8>>& bricks, int node_count) {
  CornerLists lists;
  lists.first.assign(static_cast<std::size_t>(node_count) + 1, 0);
  for (const std::array<int, 8>& brick : bricks) {
    for (const int node : brick) ++lists.first[static_cast<std::size_t>(node) + 1];
  }
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  lists.corners.resize(8 * bricks.size());
  int corner = 0;
  for (const std::array<int, 8>& brick : bricks) {
    for (const int node : brick) {
      int& place = next[static_cast<std::size_t>(node)];
      lists.corners[static_cast<std::size_t>(place++)] = corner++;
    }
  }
  return lists;
}

}  // namespace sprung
