#include "core/body/brick_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <unordered_map>

#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

bool comes_before(const Eigen::Vector3i& a, const Eigen::Vector3i& b) {
  return std::array{a.z(), a.y(), a.x()} < std::array{b.z(), b.y(), b.x()};
}

/// Whether the high side of one brick is the low side of the other.
bool are_joined(const BrickGrid& grid, std::size_t brick, std::size_t next, int axis) {
  for (int corner = 0; corner < 8; ++corner) {
    if (on_high_side(corner, axis)) continue;
    const std::size_t low = corner;
    if (grid.nodes[next][low] != grid.nodes[brick][low | 1U << unsigned(axis)]) return false;
  }
  return true;
}

/// The first brick behind this one, or the number of bricks. `from`: where the search begins, at or before the result.
std::size_t brick_behind(const BrickGrid& grid, std::size_t brick, int axis, std::size_t& from) {
  const Eigen::Vector3i cell = grid.cells[brick] + Eigen::Vector3i::Unit(axis);
  while (from < grid.cells.size() && comes_before(grid.cells[from], cell)) ++from;
  for (std::size_t next = from; next < grid.cells.size() && grid.cells[next] == cell; ++next) {
    if (are_joined(grid, brick, next, axis)) return next;
  }
  return grid.cells.size();
}

}  // namespace

FaceShares share_faces(const BrickGrid& grid, const std::vector<double>& shares) {
  FaceShares faces;
  faces.low.fill(shares);
  faces.high.fill(std::vector<double>(shares.size(), 0));
  // Cells ascend, and so do those behind them. All axes at once: a large body's bricks are loaded from memory only
  // once.
  std::array<std::size_t, 3> from{};
  for (std::size_t brick = 0; brick < shares.size(); ++brick) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = brick_behind(grid, brick, int(axis), from[axis]);
      (next < shares.size() ? faces.low[axis][next] : faces.high[axis][brick]) += shares[brick];
    }
  }
  return faces;
}

namespace {

/// Numbers the points of a lattice whose nodes are in its order.
std::vector<int> slots_of(const std::vector<Eigen::Vector3i>& lattice) {
  std::vector<int> slots(lattice.size(), 0);
  for (std::size_t i = 1; i < lattice.size(); ++i) {
    slots[i] = slots[i - 1] + (lattice[i] == lattice[i - 1] ? 0 : 1);
  }
  return slots;
}

/// The occupant of a lattice point in each layer.
class Holders {
 public:
  explicit Holders(const std::vector<Eigen::Vector3i>& lattice) : slots_(slots_of(lattice)) {}

  /// The first layer in which these nodes meet no others.
  [[nodiscard]] std::size_t layer_for(const std::array<int, 8>& nodes) const {
    std::size_t layer = 0;
    while (layer < holders_.size() && !is_free(holders_[layer], nodes)) ++layer;
    return layer;
  }
  void put(std::size_t layer, const std::array<int, 8>& nodes) {
    if (layer == holders_.size()) holders_.emplace_back();
    for (const int node : nodes) holders_[layer].emplace(slot_of(node), node);
  }

 private:
  [[nodiscard]] int slot_of(int node) const { return slots_[node]; }
  [[nodiscard]] bool is_free(const std::unordered_map<int, int>& holders, const std::array<int, 8>& nodes) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
      const auto found = holders.find(slot_of(node));
      return found == holders.end() || found->second == node;
    });
  }

  std::vector<int> slots_;
  std::vector<std::unordered_map<int, int>> holders_;
};

bool has_no_doubles(const std::vector<Eigen::Vector3i>& ordered) {
  return std::adjacent_find(ordered.begin(), ordered.end()) == ordered.end();
}

}  // namespace

std::vector<int> all_bricks(const BrickGrid& grid) {
  std::vector<int> all(grid.cells.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<std::vector<int>> layers_of(const BrickGrid& grid, const std::vector<int>& bricks) {
  if (bricks.empty()) return {};
  if (has_no_doubles(grid.lattice)) return {bricks};
  Holders holders(grid.lattice);
  std::vector<std::vector<int>> layers;
  for (const int brick : bricks) {
    const std::size_t layer = holders.layer_for(grid.nodes[brick]);
    holders.put(layer, grid.nodes[brick]);
    if (layer == layers.size()) layers.emplace_back();
    layers[layer].push_back(brick);
  }
  return layers;
}

namespace {

using Cell = Eigen::Vector3i;

struct Box {
  Cell low;
  Cell high;  // one past
};

constexpr int kMaxWide = 96;      // bricks along x
constexpr int kMaxBricks = 8192;  // of a tile
constexpr int kMinDeep = 4;       // bricks along z, since planes between tiles are computed twice
constexpr int kShortRow = 24;     // slots

constexpr int kNone = -1;    // owner of nodes that no tile has
constexpr int kShared = -2;  // ... that more than one has

Box bounds_of(const BrickGrid& grid, std::span<const int> bricks) {
  Box box{grid.cells[bricks.front()], grid.cells[bricks.front()]};
  for (const int brick : bricks) {
    const Cell& cell = grid.cells[brick];
    box.low = box.low.cwiseMin(cell);
    box.high = box.high.cwiseMax(cell + Cell::Ones());
  }
  return box;
}

/// The number of equal parts of at most `most` into which a length is divided.
int parts_of(int length, int most) { return (length + most - 1) / most; }

/// Indices from one row of nodes to the next. No pack of any width, with the neighbour behind it, holds nodes of two
/// rows, else the order in which the forces on a node add up would depend on the width, and so would the last bits.
int pitch_of(int bricks_along_x) { return std::max(bricks_along_x, kPackPadding) + 1; }

/// The parts of a box of this size along each axis: two planes of nodes fit a core's own cache.
Cell cuts_of(const Cell& size) {
  const int x = parts_of(size.x(), kMaxWide);
  const int wide = parts_of(size.x(), x);
  const int y = parts_of(size.y(), kMaxSlots / pitch_of(wide) - 1);
  const int rows = parts_of(size.y(), y);
  return {x, y, parts_of(size.z(), std::max(kMaxBricks / (wide * rows), kMinDeep))};
}

/// The bricks of each tile, ascending.
std::vector<std::vector<int>> cut(const BrickGrid& grid, const std::vector<int>& bricks) {
  const Box box = bounds_of(grid, bricks);
  const Cell size = box.high - box.low;
  const Cell counts = cuts_of(size);
  std::vector<std::vector<int>> tiles(counts.prod());
  for (const int brick : bricks) {
    const Cell slot = grid.cells[brick] - box.low;
    const Cell tile = slot.cwiseProduct(counts).cwiseQuotient(size);
    tiles[tile.x() + counts.x() * (tile.y() + counts.y() * tile.z())].push_back(brick);
  }
  std::erase_if(tiles, [](const std::vector<int>& tile) { return tile.empty(); });
  return tiles;
}

/// The tile that has a node, or kShared, or kNone.
std::vector<int> owners_of(const BrickGrid& grid, const std::vector<std::vector<int>>& tiles) {
  std::vector<int> owners(grid.lattice.size(), kNone);
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    for (const int brick : tiles[tile]) {
      for (const int node : grid.nodes[brick]) {
        int& owner = owners[node];
        const bool is_new = owner == kNone || owner == int(tile);
        owner = is_new ? int(tile) : kShared;
      }
    }
  }
  return owners;
}

/// A tile, and its contributions to shared nodes: offsets count from the tile's own.
struct MadeTile {
  BrickTile tile;
  std::vector<SharedPart> parts;
  std::size_t shared_size = 0;
};

/// Lists the runs of one tile.
class TileMaker {
 public:
  TileMaker(const BrickGrid& grid, const PackNumbers& numbers, const FaceShares& faces, const std::vector<int>& bricks)
      : numbers_(numbers), faces_(faces), box_(bounds_of(grid, bricks)) {
    const Cell size = box_.high - box_.low;
    tile_.pitch = pitch_of(size.x());
    tile_.planes = size.z() + 1;
    slots_ = kFirstSlot + (size.y() + 1) * tile_.pitch + kPackPadding;
    const auto all = std::size_t(tile_.planes) * std::size_t(slots_);
    bricks_.assign(all, -1);
    nodes_.assign(all, -1);
    for (std::vector<double>& face : last_faces_) face.assign(all, 0);
    for (const int brick : bricks) put(grid, brick);
  }

  MadeTile make(const std::vector<int>& owners) {
    for (int plane = 0; plane < tile_.planes; ++plane) {
      list_nodes(plane);
      list_pulled(plane, owners, false);
      list_pulled(plane, owners, true);
      list_slots(plane);
      list_bricks(plane);
      for (const std::vector<double>& face : last_faces_) list_faces(plane, face);
    }
    close_list();
    return {std::move(tile_), std::move(parts_), shared_size_};
  }

 private:
  [[nodiscard]] std::size_t slot(int plane, int index) const {
    return std::size_t(plane) * std::size_t(slots_) + std::size_t(index);
  }

  void put(const BrickGrid& grid, int brick) {
    const std::size_t b = brick;
    const Cell cell = grid.cells[b] - box_.low;
    const int index = kFirstSlot + cell.y() * tile_.pitch + cell.x();
    bricks_[slot(cell.z(), index)] = brick;
    for (int corner = 0; corner < 8; ++corner) {
      const int there = index + (on_high_side(corner, 0) ? 1 : 0) + (on_high_side(corner, 1) ? tile_.pitch : 0);
      nodes_[slot(cell.z() + (on_high_side(corner, 2) ? 1 : 0), there)] = grid.nodes[b][corner];
    }
    if (faces_.high[0].empty()) return;
    last_faces_[0][slot(cell.z() + 1, index)] = faces_.high[2][b];
    last_faces_[1][slot(cell.z(), index + tile_.pitch)] = faces_.high[1][b];
    last_faces_[2][slot(cell.z(), index + 1)] = faces_.high[0][b];
  }

  /// Lists are made in the order of RunKind, plane by plane.
  void close_list() { tile_.first_run.push_back(isize(tile_.runs)); }

  /// Calls visit(index, count) for packs that hold all such slots, as long as they follow each other. They begin at
  /// multiples of a pack, where fewer loads straddle two cache lines, except for a short row that then takes one less.
  template <class IsIn, class Visit>
  void each_run_of_packs(const IsIn& is_in, const Visit& visit) const {
    int begin = 0;
    int end = 0;
    for (int index = 0; index < slots_; ++index) {
      if (index < end || !is_in(index)) continue;
      int row_end = index + 1;
      while (row_end < slots_ && is_in(row_end)) ++row_end;
      const auto packs_from = [&](int first) { return parts_of(row_end - first, kPackPadding); };
      const int aligned = index & -kPackPadding;
      const bool is_short = row_end - index <= kShortRow && packs_from(index) < packs_from(aligned);
      const int first = is_short || aligned < end ? index : aligned;
      if (first > end) {
        if (end > begin) visit(begin, end - begin);
        begin = first;
        end = first;
      }
      end += kPackPadding * packs_from(first);
    }
    if (end > begin) visit(begin, end - begin);
  }

  void add_run(int index, int count, std::size_t first, int node = 0) {
    tile_.runs.push_back({.index = index, .count = count, .first = int(first), .node = node});
  }

  /// Calls visit(index, count) for nodes that follow each other in the plane and in the body.
  template <class IsIn, class Visit>
  void each_run_of_nodes(int plane, const IsIn& is_in, const Visit& visit) const {
    const auto node_at = [&](int index) { return nodes_[slot(plane, index)]; };
    const auto has = [&](int index) { return index < slots_ && node_at(index) >= 0 && is_in(node_at(index)); };
    for (int index = 0; index < slots_; ++index) {
      if (!has(index)) continue;
      const int begin = index;
      while (has(index + 1) && node_at(index + 1) == node_at(index) + 1) ++index;
      visit(begin, index + 1 - begin);
    }
  }

  void list_nodes(int plane) {
    close_list();
    const auto all = [](int) { return true; };
    each_run_of_nodes(plane, all, [&](int index, int count) { add_run(index, count, 0, nodes_[slot(plane, index)]); });
  }

  /// Nodes that only this tile contributes to, or shared ones.
  void list_pulled(int plane, const std::vector<int>& owners, bool shared) {
    close_list();
    each_run_of_nodes(
        plane, [&](int node) { return (owners[node] == kShared) == shared; },
        [&](int begin, int count) {
          const int node = nodes_[slot(plane, begin)];
          add_run(begin, count, shared_size_, node);
          if (!shared) return;
          parts_.push_back({node, count, shared_size_});
          shared_size_ += 3 * std::size_t(count);
        });
  }

  void list_slots(int plane) {
    close_list();
    each_run_of_packs([&](int index) { return nodes_[slot(plane, index)] >= 0; },
                      [&](int index, int count) { add_run(index, count, 0); });
  }

  void list_bricks(int plane) {
    close_list();
    const auto brick_at = [&](int index) { return bricks_[slot(plane, index)]; };
    each_run_of_packs([&](int index) { return brick_at(index) >= 0; },
                      [&](int begin, int count) {
                        add_run(begin, count, tile_.packs.size());
                        for (int index = begin; index < begin + count; index += kPackPadding) {
                          std::array<int, kPackPadding> pack{};
                          for (int i = 0; i < kPackPadding; ++i) pack[i] = brick_at(index + i);
                          tile_.packs.push_back(keep(numbers_(pack)));
                        }
                      });
  }

  /// The offset of these numbers; repeated ones are stored once.
  int keep(std::vector<double> pack) {
    const auto [known, is_new] = kept_.try_emplace(std::move(pack), isize(tile_.shares));
    if (is_new) tile_.shares.insert(tile_.shares.end(), known->first.begin(), known->first.end());
    return known->second;
  }

  /// Faces on the high side of bricks without a neighbour there.
  void list_faces(int plane, const std::vector<double>& shares) {
    close_list();
    const auto share_at = [&](int index) { return shares[slot(plane, index)]; };
    each_run_of_packs([&](int index) { return share_at(index) > 0; },
                      [&](int begin, int count) {
                        add_run(begin, count, tile_.shares.size());
                        for (int index = begin; index < begin + count; ++index) tile_.shares.push_back(share_at(index));
                      });
  }

  const PackNumbers& numbers_;
  const FaceShares& faces_;
  Box box_;
  int slots_ = 0;                                  // of a plane, with room for a pack behind the last node
  std::vector<int> bricks_;                        // at each slot of each plane, or -1
  std::vector<int> nodes_;                         // likewise
  std::array<std::vector<double>, 3> last_faces_;  // xy, zx and yz: shares, likewise, or 0
  BrickTile tile_;
  std::map<std::vector<double>, int> kept_;
  std::vector<SharedPart> parts_;
  std::size_t shared_size_ = 0;
};

void add(MadeTile made, BrickTiles& tiles) {
  for (const SharedPart& part : made.parts) {
    tiles.parts.push_back({part.node, part.count, tiles.shared_size + part.offset});
  }
  made.tile.shared_offset = tiles.shared_size;
  tiles.shared_size += made.shared_size;
  tiles.tiles.push_back(std::move(made.tile));
}

/// Merges overlapping parts into one list of nodes to sum.
void join_parts(BrickTiles& tiles) {
  std::stable_sort(tiles.parts.begin(), tiles.parts.end(),
                   [](const SharedPart& a, const SharedPart& b) { return a.node < b.node; });
  for (std::size_t i = 0; i < tiles.parts.size(); ++i) {
    const SharedPart& part = tiles.parts[i];
    const bool joins = !tiles.shared.empty() && part.node < tiles.shared.back().node + tiles.shared.back().count;
    if (!joins) tiles.shared.push_back({part.node, part.count, i, i + 1});
    SharedNodes& nodes = tiles.shared.back();
    nodes.count = std::max(nodes.count, part.node + part.count - nodes.node);
    nodes.last_part = i + 1;
  }
}

constexpr int kMaxOthers = 64;  // nodes at a time, so that threads share those of a body without tiles

/// Nodes that no tile has are shared ones without parts.
void add_others(const std::vector<int>& owners, BrickTiles& tiles) {
  for (int node = 0; node < isize(owners); ++node) {
    if (owners[node] != kNone) continue;
    const int first = node;
    const int last = std::min(first + kMaxOthers, isize(owners)) - 1;
    while (node < last && owners[node + 1] == kNone) ++node;
    tiles.shared.push_back({first, node + 1 - first, 0, 0});
  }
}

}  // namespace

BrickTiles make_brick_tiles(const BrickGrid& grid, const std::vector<int>& tiled, const PackNumbers& numbers,
                            const FaceShares& faces) {
  BrickTiles result;
  std::vector<std::vector<int>> tiles;
  for (const std::vector<int>& layer : layers_of(grid, tiled)) {
    for (std::vector<int>& tile : cut(grid, layer)) tiles.push_back(std::move(tile));
  }
  const std::vector<int> owners = owners_of(grid, tiles);
  std::vector<MadeTile> made(tiles.size());
  tbb::parallel_for(std::size_t{0}, tiles.size(),
                    [&](std::size_t i) { made[i] = TileMaker(grid, numbers, faces, tiles[i]).make(owners); });
  for (MadeTile& one : made) add(std::move(one), result);
  join_parts(result);
  add_others(owners, result);
  return result;
}

BrickTiles make_spring_tiles(const BrickGrid& grid, const std::vector<double>& stiffness_scale) {
  const FaceShares faces = share_faces(grid, stiffness_scale);
  const auto numbers = [&](const std::array<int, kPackPadding>& bricks) {
    std::vector<double> pack;
    for (const std::vector<double>* list : {&stiffness_scale, &faces.low[2], &faces.low[1], &faces.low[0]}) {
      for (const int brick : bricks) pack.push_back(brick < 0 ? 0 : (*list)[brick]);
    }
    return pack;
  };
  return make_brick_tiles(grid, all_bricks(grid), numbers, faces);
}

}  // namespace sprung
