#include "core/bricks/slivers.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr double kStrongFill = 0.5;

using Neighbours = std::array<int, 6>;

/// The fullest neighbour, or -1 if none is strong enough.
int strongest(const BrickGrid& grid, const Neighbours& neighbours) {
  int best = -1;
  double best_fill = kStrongFill;
  for (const int neighbour : neighbours) {
    if (neighbour < 0 || grid.fill[neighbour] < best_fill) continue;
    best = neighbour;
    best_fill = grid.fill[neighbour];
  }
  return best;
}

constexpr double kSpeckFill = 0.002;
constexpr double kHingedShare = 0.01;  // of the body, up to which a part attached by a hinge is given up

/// Bricks that are connected without the others, by their nodes.
DisjointSets connected(const BrickGrid& grid, const std::function<bool(std::size_t)>& is_meant) {
  DisjointSets nodes(grid.lattice.size());
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    if (!is_meant(i)) continue;
    for (const int node : grid.nodes[i]) nodes.merge(grid.nodes[i][0], node);
  }
  return nodes;
}

/// For each removed brick, the fullest of those kept at its own nodes (`fullest_at_node`: -1: none); if there is none,
/// that of a removed neighbour.
std::vector<int> heirs_of(const BrickGrid& grid, const std::vector<bool>& gone, std::vector<int> fullest_at_node) {
  std::vector<int> heir(grid.cells.size(), -1);
  for (bool is_done = false; !is_done;) {
    is_done = true;
    std::vector<int> found;
    for (int brick = 0; brick < grid.brick_count(); ++brick) {
      if (!gone[brick] || heir[brick] >= 0) continue;
      for (const int node : grid.nodes[brick]) {
        const int one = fullest_at_node[node];
        if (one >= 0 && (heir[brick] < 0 || grid.fill[one] > grid.fill[heir[brick]])) heir[brick] = one;
      }
      if (heir[brick] >= 0) found.push_back(brick);
    }
    for (const int brick : found) {
      for (const int node : grid.nodes[brick]) {
        if (fullest_at_node[node] < 0) fullest_at_node[node] = heir[brick];
      }
      is_done = false;
    }
  }
  return heir;
}

/// Removes almost empty bricks that absorb_slivers() leaves because no face neighbour is full: they are attached to the
/// body by a hinge or a chain of their kind. They are merged into the fullest brick that they touch, or that their
/// neighbours touch, unless they connect parts that are not connected otherwise. A chain is not merged into one brick:
/// its points follow that brick and would be extrapolated from afar.
int absorb_specks(BrickGrid& grid) {
  const auto is_speck = [&](std::size_t brick) { return grid.fill[brick] < kSpeckFill; };
  DisjointSets groups = connected(grid, is_speck);
  DisjointSets parts = connected(grid, [&](std::size_t brick) { return !is_speck(brick); });
  constexpr int kNone = -1;
  constexpr int kSeveral = -2;
  std::vector<int> part_of_node(grid.lattice.size(), kNone);
  std::vector<int> fullest_at_node(grid.lattice.size(), kNone);
  const auto take_fuller = [&](int& best, int brick) {
    if (brick != kNone && (best == kNone || grid.fill[brick] > grid.fill[best])) best = brick;
  };
  for (int brick = 0; brick < grid.brick_count(); ++brick) {
    if (is_speck(brick)) continue;
    for (const int node : grid.nodes[brick]) {
      part_of_node[node] = parts.find(node);
      take_fuller(fullest_at_node[node], brick);
    }
  }
  std::vector<int> part(grid.lattice.size(), kNone);  // to which a group is attached, by the root of the group
  for (int brick = 0; brick < grid.brick_count(); ++brick) {
    if (!is_speck(brick)) continue;
    const int group = groups.find(grid.nodes[brick][0]);
    for (const int node : grid.nodes[brick]) {
      if (part_of_node[node] == kNone) continue;
      part[group] = part[group] == kNone || part[group] == part_of_node[node] ? part_of_node[node] : kSeveral;
    }
  }
  std::vector<bool> gone(grid.cells.size(), false);
  for (int brick = 0; brick < grid.brick_count(); ++brick) {
    gone[brick] = is_speck(brick) && part[groups.find(grid.nodes[brick][0])] >= 0;
  }
  const std::vector<int> heir = heirs_of(grid, gone, fullest_at_node);
  for (int brick = 0; brick < grid.brick_count(); ++brick) {
    if (gone[brick]) grid.fill[heir[brick]] += grid.fill[brick];
  }
  remove_bricks(grid, gone, heir);
  return int(std::count(gone.begin(), gone.end(), true));
}

bool are_on_a_line(const std::vector<Eigen::Vector3i>& positions) {
  Eigen::Vector3i along = Eigen::Vector3i::Zero();
  for (const Eigen::Vector3i& position : positions) {
    const Eigen::Vector3i way = position - positions.front();
    if (along.isZero()) along = way;
    if (!along.cross(way).isZero()) return false;
  }
  return true;
}

/// The bricks that are connected through faces, by their smallest member.
DisjointSets connected_by_faces(const BrickGrid& grid) {
  const CellIndex index(grid);
  DisjointSets parts(grid.cells.size());
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    for (const int other : face_neighbours(grid, index, brick)) {
      if (other >= 0) parts.merge(int(brick), other);
    }
  }
  return parts;
}

/// Small parts that touch one other part only in nodes on a line can turn about it without resistance, so that no
/// equilibrium can be found. They are merged into the fullest brick at the hinge. Returns the number of bricks.
int absorb_hinged(BrickGrid& grid) {
  const std::size_t count = grid.cells.size();
  DisjointSets parts = connected_by_faces(grid);
  std::vector<double> volumes(count, 0);
  for (std::size_t brick = 0; brick < count; ++brick) volumes[parts.find(int(brick))] += grid.fill[brick];
  const double total = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  const CornerLists lists = list_corners(grid.nodes, grid.node_count());

  struct Hinge {
    int beyond = -1;  // the part that it is attached to
    bool is_one = true;
    int heir = -1;
    std::vector<Eigen::Vector3i> positions;
  };
  std::map<int, Hinge> hinges;  // by part
  for (int node = 0; node < grid.node_count(); ++node) {
    for (int a = lists.first[node]; a < lists.first[node + 1]; ++a) {
      const int part = parts.find(lists.corners[a] / 8);
      if (volumes[part] > kHingedShare * total) continue;
      for (int b = lists.first[node]; b < lists.first[node + 1]; ++b) {
        const int other = lists.corners[b] / 8;
        if (parts.find(other) == part) continue;
        Hinge& hinge = hinges[part];
        if (hinge.beyond < 0) hinge.beyond = parts.find(other);
        hinge.is_one = hinge.is_one && hinge.beyond == parts.find(other);
        if (hinge.heir < 0 || grid.fill[other] > grid.fill[hinge.heir]) hinge.heir = other;
        hinge.positions.push_back(grid.lattice[node]);
      }
    }
  }
  /// Of two that are attached to nothing but each other the smaller one is removed.
  const auto goes = [&](int part, const Hinge& hinge) {
    if (!hinge.is_one || !are_on_a_line(hinge.positions)) return false;
    const auto other = hinges.find(hinge.beyond);
    if (other == hinges.end() || !other->second.is_one) return true;
    return std::pair(volumes[part], -part) < std::pair(volumes[hinge.beyond], -hinge.beyond);
  };
  std::vector<bool> gone(count, false);
  std::vector<int> heir(count, -1);
  for (std::size_t brick = 0; brick < count; ++brick) {
    const auto found = hinges.find(parts.find(int(brick)));
    if (found == hinges.end() || !goes(found->first, found->second)) continue;
    gone[brick] = true;
    heir[brick] = found->second.heir;
  }
  // Chains of such parts are removed one after the other, from their end.
  const std::vector<bool> hinged = gone;
  for (std::size_t brick = 0; brick < count; ++brick) gone[brick] = hinged[brick] && !hinged[heir[brick]];
  for (std::size_t brick = 0; brick < count; ++brick) {
    if (gone[brick]) grid.fill[heir[brick]] += grid.fill[brick];
  }
  remove_bricks(grid, gone, heir);
  return int(std::count(gone.begin(), gone.end(), true));
}

}  // namespace

int absorb_slivers(BrickGrid& grid, double min_fill) {
  const CellIndex index(grid);
  const std::size_t count = grid.cells.size();
  std::vector<Neighbours> neighbours(count);
  std::vector<int> receiver(count);
  for (std::size_t i = 0; i < count; ++i) {
    neighbours[i] = face_neighbours(grid, index, i);
    receiver[i] = strongest(grid, neighbours[i]);
  }
  std::vector<bool> gone(count, false);
  std::vector<double> fill = grid.fill;
  for (std::size_t i = 0; i < count; ++i) {
    if (grid.fill[i] >= min_fill || receiver[i] < 0) continue;
    const bool is_needed = std::any_of(neighbours[i].begin(), neighbours[i].end(), [&](int other) {
      return other >= 0 && grid.fill[other] < kStrongFill && receiver[other] < 0;
    });
    if (is_needed) continue;
    gone[i] = true;
    fill[receiver[i]] += grid.fill[i];
  }
  grid.fill = std::move(fill);
  remove_bricks(grid, gone, receiver);
  int absorbed = int(std::count(gone.begin(), gone.end(), true)) + absorb_specks(grid);
  while (const int hinged = absorb_hinged(grid)) absorbed += hinged;
  return absorbed;
}

namespace {

/// Bricks are given up one after the other, the emptiest first.
class LooseBricks {
 public:
  explicit LooseBricks(const BrickGrid& grid) : grid_(grid), fill_(grid.fill), heir_(grid.cells.size(), -1) {
    const CellIndex index(grid);
    const CornerLists lists = list_corners(grid.nodes, grid.node_count());
    for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
      beside_.push_back(face_neighbours(grid, index, brick));
      std::vector<int>& around = around_.emplace_back();
      for (const int node : grid.nodes[brick]) {
        for (int i = lists.first[node]; i < lists.first[node + 1]; ++i) around.push_back(lists.corners[i] / 8);
      }
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
    }
  }

  /// The heir of each removed brick; -1: it stays.
  std::vector<int> give_up(double min_share) {
    std::vector<double> share;
    for (std::size_t brick = 0; brick < grid_.cells.size(); ++brick) {
      double fullest = 0;
      for (const int other : around_[brick]) fullest = std::max(fullest, grid_.fill[other]);
      share.push_back(grid_.fill[brick] / fullest);
    }
    std::vector<int> order(share.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return share[a] < share[b]; });
    for (const int brick : order) {
      if (share[brick] >= min_share) break;
      // A brick that has absorbed others stays: their solid is far enough away.
      if (fill_[brick] > grid_.fill[brick] || !hang_together(brick)) continue;
      const std::vector<int> sides = sides_of(brick);
      const int heir = *std::max_element(sides.begin(), sides.end(), [&](int a, int b) { return fill_[a] < fill_[b]; });
      heir_[brick] = heir;
      fill_[heir] += fill_[brick];
    }
    return heir_;
  }

  /// What the bricks then contain.
  [[nodiscard]] const std::vector<double>& fill() const { return fill_; }

 private:
  [[nodiscard]] bool is_there(int brick) const { return brick >= 0 && heir_[brick] < 0; }

  [[nodiscard]] std::vector<int> sides_of(int brick) const {
    std::vector<int> sides;
    std::copy_if(beside_[brick].begin(), beside_[brick].end(), std::back_inserter(sides),
                 [&](int other) { return is_there(other); });
    return sides;
  }

  /// The face neighbours through faces of bricks around `brick`.
  [[nodiscard]] bool hang_together(int brick) const {
    const std::vector<int> sides = sides_of(brick);
    if (sides.empty()) return false;
    std::vector<int> found{sides.front()};
    for (std::size_t next = 0; next < found.size(); ++next) {
      for (const int other : beside_[found[next]]) {
        if (!is_there(other) || other == brick) continue;
        if (!std::binary_search(around_[brick].begin(), around_[brick].end(), other)) continue;
        if (std::find(found.begin(), found.end(), other) == found.end()) found.push_back(other);
      }
    }
    return std::all_of(sides.begin(), sides.end(),
                       [&](int side) { return std::find(found.begin(), found.end(), side) != found.end(); });
  }

  const BrickGrid& grid_;
  std::vector<double> fill_;
  std::vector<int> heir_;
  std::vector<Neighbours> beside_;
  std::vector<std::vector<int>> around_;  // itself too; ascending
};

}  // namespace

int absorb_loose_bricks(BrickGrid& grid, double min_share) {
  LooseBricks bricks(grid);
  const std::vector<int> heir = bricks.give_up(min_share);
  std::vector<bool> gone;
  gone.reserve(heir.size());
  for (const int one : heir) gone.push_back(one >= 0);
  grid.fill = bricks.fill();
  remove_bricks(grid, gone, heir);
  return int(std::count(gone.begin(), gone.end(), true));
}

}  // namespace sprung
