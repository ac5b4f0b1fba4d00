#include "core/dynamics/linear/multigrid_hierarchy.h"

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "core/bricks/brick_topology.h"
#include "core/disjoint_sets.h"

namespace sprung::multigrid {
namespace {

struct CellHash {
  std::size_t operator()(const Eigen::Vector3i& cell) const {
    const auto part = [&](int axis) { return std::size_t(cell[axis] + (1 << 20)) & 0x1fffffU; };
    return part(0) | part(1) << 21U | part(2) << 42U;
  }
};

Eigen::Vector3i half(const Eigen::Vector3i& cell) { return {cell.x() >> 1, cell.y() >> 1, cell.z() >> 1}; }

int octant_of(const Eigen::Vector3i& cell) { return (cell.x() & 1) | (cell.y() & 1) << 1 | (cell.z() & 1) << 2; }

bool share_a_node(const BrickNodes& a, const BrickNodes& b) {
  return std::any_of(a.begin(), a.end(), [&](int node) { return std::find(b.begin(), b.end(), node) != b.end(); });
}

/// The children of one coarse cell, in connected groups.
std::vector<std::vector<int>> hanging_together(const std::vector<int>& children, const Layout& fine) {
  DisjointSets sets(children.size());
  for (std::size_t a = 0; a < children.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (share_a_node(fine.bricks[children[a]], fine.bricks[children[b]])) {
        sets.merge(int(a), int(b));
      }
    }
  }
  std::vector<std::vector<int>> groups(children.size());
  for (std::size_t a = 0; a < children.size(); ++a) {
    groups[sets.find(int(a))].push_back(children[a]);
  }
  std::erase_if(groups, [](const std::vector<int>& group) { return group.empty(); });
  return groups;
}

/// Adds a brick's child; to a new brick at the same cell if another child occupies its octant already (two that are not
/// connected on the finest level may be on a coarser one).
void add_child(const Layout& fine, int child, std::size_t first_brick, Layout& coarse, std::vector<int>& parents) {
  const Eigen::Vector3i& place = fine.cells[child];
  const std::size_t octant = octant_of(place);
  std::size_t brick = first_brick;
  while (brick < coarse.children.size() && coarse.children[brick][octant] >= 0) ++brick;
  if (brick == coarse.children.size()) {
    coarse.cells.push_back(half(place));
    coarse.children.emplace_back().fill(-1);
  }
  coarse.children[brick][octant] = child;
  parents[child] = int(brick);
}

/// Coarse bricks with their children; their nodes are still to be found. Returns each child's coarse brick.
std::vector<int> join_bricks(const Layout& fine, Layout& coarse) {
  std::vector<std::vector<int>> cells;
  std::unordered_map<Eigen::Vector3i, std::size_t, CellHash> cell_at;
  cell_at.reserve(fine.cells.size() / 4);
  for (std::size_t brick = 0; brick < fine.cells.size(); ++brick) {
    const auto [found, is_new] = cell_at.emplace(half(fine.cells[brick]), cells.size());
    if (is_new) cells.emplace_back();
    cells[found->second].push_back(int(brick));
  }
  std::vector<int> parents(fine.cells.size());
  for (const std::vector<int>& cell : cells) {
    for (const std::vector<int>& group : hanging_together(cell, fine)) {
      const std::size_t first_brick = coarse.cells.size();
      for (const int child : group) add_child(fine, child, first_brick, coarse, parents);
    }
  }
  return parents;
}

/// The corners of a coarse brick from which the corner of a child in `octant` is interpolated, in the order of their
/// positions.
std::vector<int> supports(int octant, int corner) {
  std::vector<int> found;
  for (int support = 0; support < 8; ++support) {
    bool counts = true;
    for (int axis = 0; axis < 3; ++axis) {
      const int index = (octant >> axis & 1) + (corner >> axis & 1);  // in half coarse bricks
      const bool high = on_high_side(support, axis);
      counts = counts && (high ? index > 0 : index < 2);
    }
    if (counts) found.push_back(support);
  }
  return found;
}

/// Calls visit(fine node, its coarse brick corners) for every corner of every fine brick.
template <class Visit>
void for_each_hanging(const Layout& fine, const std::vector<int>& parents, const Visit& visit) {
  std::array<std::array<std::vector<int>, 8>, 8> table;
  for (int octant = 0; octant < 8; ++octant) {
    for (int corner = 0; corner < 8; ++corner) {
      table[octant][corner] = supports(octant, corner);
    }
  }
  for (std::size_t brick = 0; brick < fine.bricks.size(); ++brick) {
    const std::size_t octant = octant_of(fine.cells[brick]);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      visit(fine.bricks[brick][corner], 8 * parents[brick], table[octant][corner]);
    }
  }
}

void join_nodes(Layout& fine, const std::vector<int>& parents, Layout& coarse) {
  Interpolation& hang = fine.to_coarse;
  const std::size_t fine_nodes = fine.node_count;
  hang.coarse_nodes.resize(fine_nodes);
  hang.counts.assign(fine_nodes, 0);
  DisjointSets sets(8 * coarse.cells.size());
  for_each_hanging(fine, parents, [&](std::size_t node, int first, const std::vector<int>& corners) {
    const bool is_new = hang.counts[node] == 0;
    hang.counts[node] = static_cast<std::uint8_t>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (is_new) {
        hang.coarse_nodes[node][i] = first + corners[i];
      } else {
        sets.merge(hang.coarse_nodes[node][i], first + corners[i]);
      }
    }
  });
  std::vector<int> number(8 * coarse.cells.size(), -1);
  coarse.bricks.resize(coarse.cells.size());
  for (std::size_t corner = 0; corner < number.size(); ++corner) {
    int& node = number[sets.find(int(corner))];
    if (node < 0) node = coarse.node_count++;
    coarse.bricks[corner / 8][corner % 8] = node;
  }
  for (std::size_t node = 0; node < fine_nodes; ++node) {
    for (std::size_t i = 0; i < hang.counts[node]; ++i) {
      int& corner = hang.coarse_nodes[node][i];
      corner = number[sets.find(corner)];
    }
  }
}

void list_fine_nodes(Interpolation& hang, int coarse_nodes) {
  hang.first_fine.assign(std::size_t(coarse_nodes) + 1, 0);
  for (std::size_t node = 0; node < hang.counts.size(); ++node) {
    for (std::size_t i = 0; i < hang.counts[node]; ++i) {
      ++hang.first_fine[hang.coarse_nodes[node][i] + 1];
    }
  }
  std::partial_sum(hang.first_fine.begin(), hang.first_fine.end(), hang.first_fine.begin());
  std::vector<int> next(hang.first_fine.begin(), hang.first_fine.end() - 1);
  hang.fine_nodes.resize(hang.first_fine.back());
  for (std::size_t node = 0; node < hang.counts.size(); ++node) {
    for (std::size_t i = 0; i < hang.counts[node]; ++i) {
      int& index = next[hang.coarse_nodes[node][i]];
      hang.fine_nodes[index++] = int(node);
    }
  }
}

/// Floating-point operations of a Cholesky factorization of the level's stiffness matrix, as CHOLMOD orders it.
double factorization_flops(const Layout& level) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const BrickNodes& nodes : level.bricks) {
    for (const int row : nodes) {
      for (const int column : nodes) {
        if (row >= column) entries.emplace_back(row, column, 1.0);
      }
    }
  }
  Eigen::SparseMatrix<double> pattern(level.node_count, level.node_count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky;
  cholesky.analyzePattern(pattern);
  constexpr double kPerNode = 27;  // three degrees of freedom
  return kPerNode * cholesky.cholmod().fl;
}

bool is_last(const Layout& level, const LastLevel& last) {
  return level.node_count <= last.max_nodes && factorization_flops(level) <= last.max_flops;
}

}  // namespace

std::vector<Layout> make_hierarchy(const BrickGrid& grid, const LastLevel& last) {
  std::vector<Layout> levels(1);
  levels[0].cells = grid.cells;
  levels[0].bricks = grid.nodes;
  levels[0].node_count = grid.node_count();
  levels[0].corners = list_corners(grid.nodes, grid.node_count());
  while (!is_last(levels.back(), last)) {
    Layout coarse;
    const std::vector<int> parents = join_bricks(levels.back(), coarse);
    if (coarse.cells.size() == levels.back().cells.size()) break;
    join_nodes(levels.back(), parents, coarse);
    list_fine_nodes(levels.back().to_coarse, coarse.node_count);
    coarse.corners = list_corners(coarse.bricks, coarse.node_count);
    levels.push_back(std::move(coarse));
  }
  return levels;
}

}  // namespace sprung::multigrid
