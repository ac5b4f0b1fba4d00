#include "core/body/gathered_bricks.h"

#include <algorithm>
#include <numeric>

namespace sprung {
namespace {

using PackBricks = std::array<int, kPackPadding>;  // -1: none

std::vector<PackBricks> packs_of(const std::vector<std::vector<int>>& groups) {
  std::vector<PackBricks> packs;
  for (const std::vector<int>& group : groups) {
    for (std::size_t brick = 0; brick < group.size(); ++brick) {
      if (brick % kPackPadding == 0) packs.emplace_back().fill(-1);
      packs.back()[brick % kPackPadding] = group[brick];
    }
  }
  return packs;
}

/// Calls visit(node, place of the force on it) for the corners of the packs' bricks.
template <class Visit>
void each_force(const BrickGrid& grid, const std::vector<PackBricks>& packs, const Visit& visit) {
  for (int pack = 0; pack < isize(packs); ++pack) {
    for (int corner = 0; corner < 8; ++corner) {
      for (int lane = 0; lane < kPackPadding; ++lane) {
        const int brick = packs[pack][lane];
        if (brick >= 0) visit(grid.nodes[brick][corner], kGatheredForces * pack + 3 * kPackPadding * corner + lane);
      }
    }
  }
}

/// The corners of a pack; lanes without a brick have those of the first.
void add_corners(const BrickGrid& grid, const PackBricks& bricks, std::vector<int>& corners) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (const int brick : bricks) corners.push_back(3 * grid.nodes[brick < 0 ? bricks[0] : brick][corner]);
  }
}

}  // namespace

GatheredBricks gather_bricks(const BrickGrid& grid, const std::vector<std::vector<int>>& groups,
                             const PackNumbers& numbers) {
  GatheredBricks gathered;
  const std::vector<PackBricks> packs = packs_of(groups);
  for (const PackBricks& bricks : packs) {
    gathered.packs.push_back(isize(gathered.numbers));
    const std::vector<double> own = numbers(bricks);
    gathered.numbers.insert(gathered.numbers.end(), own.begin(), own.end());
    add_corners(grid, bricks, gathered.corners);
  }
  std::vector<int>& first = gathered.first_force;
  first.assign(grid.lattice.size() + 1, 0);
  each_force(grid, packs, [&](int node, int) { ++first[node + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  gathered.force_places.resize(first.back());
  std::vector<int> next = first;
  each_force(grid, packs, [&](int node, int place) { gathered.force_places[next[node]++] = place; });
  return gathered;
}

}  // namespace sprung
