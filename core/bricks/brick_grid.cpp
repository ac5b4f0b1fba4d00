#include "core/bricks/brick_grid.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

/// Lattice points as single numbers of the same order: by z, then y, then x.
class LatticeOrder {
 public:
  explicit LatticeOrder(const std::vector<Eigen::Vector3i>& cells) {
    low_ = high_ = cells.front();
    for (const Eigen::Vector3i& cell : cells) {
      low_ = low_.cwiseMin(cell);
      high_ = high_.cwiseMax(cell);
    }
    high_.array() += 1;
  }
  [[nodiscard]] std::int64_t step(int axis) const {
    std::int64_t product = 1;
    for (int i = 0; i < axis; ++i) product *= high_[i] - low_[i] + 1;
    return product;
  }
  [[nodiscard]] std::int64_t key(const Eigen::Vector3i& point) const {
    std::int64_t sum = 0;
    for (int i = 0; i < 3; ++i) sum += step(i) * (point[i] - low_[i]);
    return sum;
  }
  [[nodiscard]] Eigen::Vector3i point(std::int64_t key) const {
    const std::int64_t row = key / step(1);
    const std::int64_t rows = step(2) / step(1);
    return low_ + Eigen::Vector3i(int(key % step(1)), int(row % rows), int(row / rows));
  }

 private:
  Eigen::Vector3i low_;
  Eigen::Vector3i high_;
};

/// The union of the sorted keys and the same shifted by `step`.
std::vector<std::int64_t> with_moved(const std::vector<std::int64_t>& keys, std::int64_t step) {
  std::vector<std::int64_t> moved(keys);
  for (std::int64_t& key : moved) key += step;
  std::vector<std::int64_t> both;
  both.reserve(keys.size() + keys.size() / 4);
  std::set_union(keys.begin(), keys.end(), moved.begin(), moved.end(), std::back_inserter(both));
  return both;
}

}  // namespace

double BrickGrid::volume() const { return std::accumulate(fill.begin(), fill.end(), 0.0) * brick_volume(); }

Points BrickGrid::rest_positions() const {
  Points positions(node_count(), 3);
  for (int m = 0; m < node_count(); ++m) {
    positions.row(m) = origin + brick_size * lattice[m].cast<double>();
  }
  return positions;
}

void number_nodes(BrickGrid& grid) {
  grid.nodes.assign(grid.cells.size(), {});
  grid.lattice.clear();
  if (grid.cells.empty()) return;
  const LatticeOrder order(grid.cells);
  std::vector<std::int64_t> cell_keys;
  cell_keys.reserve(grid.cells.size());
  for (const Eigen::Vector3i& cell : grid.cells) cell_keys.push_back(order.key(cell));

  std::vector<std::int64_t> node_keys = cell_keys;
  for (int axis = 0; axis < 3; ++axis) node_keys = with_moved(node_keys, order.step(axis));
  grid.lattice.reserve(node_keys.size());
  for (const std::int64_t key : node_keys) grid.lattice.push_back(order.point(key));

  // Both lists are ascending, so one pass over the nodes finds a given corner of every cell.
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::int64_t step = 0;
    for (int axis = 0; axis < 3; ++axis) step += (corner >> axis & 1) != 0 ? order.step(axis) : 0;
    std::size_t node = 0;
    for (std::size_t i = 0; i < cell_keys.size(); ++i) {
      while (node_keys[node] != cell_keys[i] + step) ++node;
      grid.nodes[i][corner] = int(node);
    }
  }
}

void number_nodes(BrickGrid& grid, DisjointSets& corners) {
  const LatticeOrder order(grid.cells);
  std::vector<std::pair<std::int64_t, int>> found;  // position and set of each node
  for (int corner = 0; corner < isize(corners); ++corner) {
    if (corners.find(corner) != corner) continue;
    const Eigen::Vector3i offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    found.emplace_back(order.key(grid.cells[corner / 8] + offset), corner);
  }
  std::sort(found.begin(), found.end());
  std::vector<int> node_of(corners.size(), -1);
  grid.lattice.clear();
  for (const auto& [key, corner] : found) {
    node_of[corner] = grid.node_count();
    grid.lattice.push_back(order.point(key));
  }
  grid.nodes.resize(grid.cells.size());
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    grid.nodes[corner / 8][corner % 8] = node_of[corners.find(int(corner))];
  }
}

void remove_bricks(BrickGrid& grid, const std::vector<bool>& gone, const std::vector<int>& heir) {
  std::vector<int> new_row(grid.cells.size(), -1);
  std::vector<int> new_node(grid.lattice.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (gone[i]) continue;
    grid.cells[kept] = grid.cells[i];
    grid.fill[kept] = grid.fill[i];
    grid.nodes[kept] = grid.nodes[i];
    for (const int node : grid.nodes[i]) new_node[node] = 0;
    new_row[i] = int(kept++);
  }
  grid.cells.resize(kept);
  grid.fill.resize(kept);
  grid.nodes.resize(kept);
  int nodes = 0;
  for (std::size_t m = 0; m < grid.lattice.size(); ++m) {
    if (new_node[m] < 0) continue;
    grid.lattice[nodes] = grid.lattice[m];
    new_node[m] = nodes++;
  }
  grid.lattice.resize(nodes);
  for (auto& corners : grid.nodes) {
    for (int& node : corners) node = new_node[node];
  }
  for (SolidPatch& patch : grid.patches) {
    const std::size_t brick = patch.brick;
    patch.brick = new_row[gone[brick] ? heir[brick] : patch.brick];
  }
}

int count_connected(const BrickGrid& grid) {
  DisjointSets sets(grid.lattice.size());
  for (const auto& corners : grid.nodes) {
    for (const int node : corners) sets.merge(corners[0], node);
  }
  int count = 0;
  for (int node = 0; node < grid.node_count(); ++node) count += sets.find(node) == node ? 1 : 0;
  return count;
}

BrickGrid make_box_grid(const Eigen::Vector3i& counts, double brick_size) {
  BrickGrid grid;
  grid.brick_size = brick_size;
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x) grid.cells.emplace_back(x, y, z);
    }
  }
  grid.fill.assign(grid.cells.size(), 1.0);
  number_nodes(grid);
  return grid;
}

namespace {

/// Whether brick `other` shares the face of `brick` on that side.
bool shares_face(const BrickGrid& grid, std::size_t brick, std::size_t other, int side) {
  const int axis = side / 2;
  const bool high = side % 2 != 0;
  for (int corner = 0; corner < 8; ++corner) {
    if (on_high_side(corner, axis) != high) continue;
    const std::size_t across = corner ^ (1 << axis);
    if (grid.nodes[brick][corner] != grid.nodes[other][across]) return false;
  }
  return true;
}

}  // namespace

std::array<int, 6> face_neighbours(const BrickGrid& grid, const CellIndex& index, std::size_t brick) {
  std::array<int, 6> neighbours{};
  for (int side = 0; side < 6; ++side) {
    Eigen::Vector3i cell = grid.cells[brick];
    cell[side / 2] += side % 2 == 0 ? -1 : 1;
    int other = index.at(cell);
    while (other >= 0 && !shares_face(grid, brick, other, side)) {
      ++other;
      if (other == grid.brick_count() || grid.cells[other] != cell) other = -1;
    }
    neighbours[side] = other;
  }
  return neighbours;
}

CornerLists list_corners(const std::vector<std::array<int, 8>>& bricks, int node_count) {
  CornerLists lists;
  lists.first.assign(std::size_t(node_count) + 1, 0);
  for (const std::array<int, 8>& brick : bricks) {
    for (const int node : brick) ++lists.first[node + 1];
  }
  std::partial_sum(lists.first.begin(), lists.first.end(), lists.first.begin());
  std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
  lists.corners.resize(8 * bricks.size());
  int corner = 0;
  for (const std::array<int, 8>& brick : bricks) {
    for (const int node : brick) {
      int& index = next[node];
      lists.corners[index++] = corner++;
    }
  }
  return lists;
}

namespace {

/// Of a brick, on one side.
std::array<int, 4> corners_on(int side) {
  const int axis = side / 2;
  const bool high = side % 2 != 0;
  const int base = high ? 1 << axis : 0;
  const int j = 1 << ((axis + 1) % 3);
  const int k = 1 << ((axis + 2) % 3);
  std::array<int, 4> corners{base, base | j, base | j | k, base | k};
  if (!high) std::swap(corners[1], corners[3]);
  return corners;
}

std::array<int, 4> sorted(std::array<int, 4> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

std::vector<BrickFace> brick_faces(const BrickGrid& grid, const std::vector<bool>& shown) {
  std::vector<BrickFace> faces;
  faces.reserve(6 * grid.nodes.size());
  for (std::size_t brick = 0; brick < grid.nodes.size(); ++brick) {
    if (!shown[brick]) continue;
    for (int side = 0; side < 6; ++side) {
      BrickFace face{.nodes = {}, .side = side, .brick = int(brick)};
      const std::array<int, 4> corners = corners_on(side);
      for (std::size_t c = 0; c < 4; ++c) face.nodes[c] = grid.nodes[brick][corners[c]];
      faces.push_back(face);
    }
  }
  return faces;
}

std::vector<BrickFace> outer_faces(const BrickGrid& grid, const std::vector<bool>& shown) {
  std::vector<BrickFace> faces = brick_faces(grid, shown);
  std::map<std::array<int, 4>, int> uses;
  for (const BrickFace& face : faces) ++uses[sorted(face.nodes)];
  std::erase_if(faces, [&](const BrickFace& face) { return uses[sorted(face.nodes)] > 1; });
  return faces;
}

std::vector<BrickFace> outer_faces(const BrickGrid& grid) {
  return outer_faces(grid, std::vector<bool>(grid.nodes.size(), true));
}

}  // namespace sprung
