#include "core/body/brick_tiles.h"

#include <algorithm>

namespace sprung {
namespace {

using Cell = Eigen::Vector3i;

const Eigen::Vector3i kTileSize(kTileWidth, 8, 16);  // bricks; two planes of nodes then fit a core's own cache

/// Finds cells, or nodes, of a sorted list by their row.
class RowIndex {
 public:
  explicit RowIndex(const std::vector<Cell>& cells) : cells_(cells), low_(cells.front()), high_(cells.front()) {
    for (const Cell& cell : cells) {
      low_ = low_.cwiseMin(cell);
      high_ = high_.cwiseMax(cell);
    }
    first_.assign(static_cast<std::size_t>(rows() * (high_.z() - low_.z() + 1)) + 1, 0);
    for (const Cell& cell : cells) ++first_[slot(cell.y(), cell.z()) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  }

  [[nodiscard]] const Cell& low() const { return low_; }
  [[nodiscard]] const Cell& high() const { return high_; }

  /// Calls visit(index, x) for the cells of a row with x0 <= x < x1.
  template <class Visit>
  void each(int x0, int x1, int y, int z, const Visit& visit) const {
    if (y < low_.y() || y > high_.y() || z < low_.z() || z > high_.z()) return;
    for (int i = lower_bound(x0, y, z); i < first_[slot(y, z) + 1]; ++i) {
      const int x = cells_[static_cast<std::size_t>(i)].x();
      if (x >= x1) return;
      visit(i, x);
    }
  }

  [[nodiscard]] bool has_any(const Cell& low, const Cell& high) const {
    for (int z = low.z(); z < high.z(); ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        bool found = false;
        each(low.x(), high.x(), y, z, [&](int, int) { found = true; });
        if (found) return true;
      }
    }
    return false;
  }

  /// The first of a row at x or beyond.
  [[nodiscard]] int lower_bound(int x, int y, int z) const {
    const auto begin = cells_.begin() + first_[slot(y, z)];
    const auto end = cells_.begin() + first_[slot(y, z) + 1];
    const auto found = std::lower_bound(begin, end, x, [](const Cell& cell, int value) { return cell.x() < value; });
    return static_cast<int>(found - cells_.begin());
  }

 private:
  [[nodiscard]] int rows() const { return high_.y() - low_.y() + 1; }
  [[nodiscard]] std::size_t slot(int y, int z) const {
    return static_cast<std::size_t>((z - low_.z()) * rows() + (y - low_.y()));
  }

  const std::vector<Cell>& cells_;
  Cell low_;
  Cell high_;
  std::vector<int> first_;
};

/// The bricks' shares in a box and one brick around it; 0: no brick.
class ShareBox {
 public:
  ShareBox(const RowIndex& bricks, const std::vector<double>& shares, const Cell& low, const Cell& high)
      : low_(low), high_(high), size_(high - low + Cell::Constant(2)) {
    values_.assign(static_cast<std::size_t>(size_.prod()), 0);
    inside_ = values_;
    for (int z = low.z() - 1; z <= high.z(); ++z) {
      for (int y = low.y() - 1; y <= high.y(); ++y) {
        bricks.each(low.x() - 1, high.x() + 1, y, z,
                    [&](int brick, int x) { set(x, y, z, shares[static_cast<std::size_t>(brick)]); });
      }
    }
  }

  [[nodiscard]] double at(int x, int y, int z) const { return values_[slot(x, y, z)]; }
  /// 0 outside the box proper.
  [[nodiscard]] double inside(int x, int y, int z) const { return inside_[slot(x, y, z)]; }
  [[nodiscard]] const Cell& low() const { return low_; }
  [[nodiscard]] const Cell& high() const { return high_; }

 private:
  [[nodiscard]] std::size_t slot(int x, int y, int z) const {
    const int plane = z - low_.z() + 1;
    const int row = y - low_.y() + 1;
    return static_cast<std::size_t>((plane * size_.y() + row) * size_.x() + x - low_.x() + 1);
  }
  void set(int x, int y, int z, double share) {
    const Cell cell(x, y, z);
    values_[slot(x, y, z)] = share;
    const bool is_inside = (cell.array() >= low_.array()).all() && (cell.array() < high_.array()).all();
    if (is_inside) inside_[slot(x, y, z)] = share;
  }

  Cell low_;
  Cell high_;
  Cell size_;
  std::vector<double> values_;
  std::vector<double> inside_;
};

/// Lists the runs of one tile.
class TileMaker {
 public:
  TileMaker(const ShareBox& box, const RowIndex& nodes, const Cell& body_low, const Cell& body_high)
      : box_(box), nodes_(nodes), body_low_(body_low), body_high_(body_high) {
    const Cell size = box.high() - box.low();
    tile_.rows = size.y() + 1;
    tile_.planes = size.z() + 1;
  }

  BrickTile make(std::vector<SharedPart>& parts, std::size_t& shared_size) {
    tile_.shared_offset = shared_size;
    for (int z = box_.low().z(); z <= box_.high().z(); ++z) {
      for (int y = box_.low().y(); y <= box_.high().y(); ++y) {
        list_nodes(y, z, false, parts, shared_size);
        list_nodes(y, z, true, parts, shared_size);
        list_edges(y, z);
        list_bricks(y, z);
        list_faces(y, z);
      }
    }
    close_list();
    return std::move(tile_);
  }

 private:
  /// Lists are made in the order of RunKind, row by row and plane by plane.
  void close_list() { tile_.first_run.push_back(static_cast<int>(tile_.runs.size())); }

  /// One list of runs where share(x) is above 0, whose numbers go to `shares`.
  template <class Share>
  void list(const Share& share) {
    close_list();
    each_run([&](int x) { return share(x) > 0; },
             [&](int x, int count) {
               tile_.runs.push_back(run(x, count, static_cast<int>(tile_.shares.size())));
               for (int i = 0; i < count; ++i) tile_.shares.push_back(share(x + i));
               pad();
             });
  }

  void pad() { tile_.shares.resize((tile_.shares.size() + kRunPadding - 1) / kRunPadding * kRunPadding, 0); }

  [[nodiscard]] Run run(int x, int count, int first) const {
    return {.x = x - box_.low().x() + kFirstPlace, .count = count, .first = first, .node = 0};
  }

  template <class IsIn, class Visit>
  void each_run(const IsIn& is_in, const Visit& visit) const {
    for (int x = box_.low().x(); x <= box_.high().x(); ++x) {
      const int begin = x;
      while (x <= box_.high().x() && is_in(x)) ++x;
      if (x > begin) visit(begin, x - begin);
    }
  }

  /// Whether other tiles may have bricks at a node.
  [[nodiscard]] bool is_shared(const Cell& node) const {
    const auto on_cut = node.array() == box_.low().array() && box_.low().array() > body_low_.array();
    const auto on_high_cut = node.array() == box_.high().array() && box_.high().array() < body_high_.array();
    return (on_cut || on_high_cut).any();
  }

  void list_nodes(int y, int z, bool shared, std::vector<SharedPart>& parts, std::size_t& shared_size) {
    close_list();
    const auto around = [&](int x) {
      return box_.inside(x, y - 1, z - 1) + box_.inside(x, y, z - 1) + box_.inside(x, y - 1, z) + box_.inside(x, y, z);
    };
    each_run(
        [&](int x) {
          return around(x - 1) + around(x) > 0 && is_shared({x, y, z}) == shared;
        },
        [&](int x, int count) {
          Run nodes = run(x, count, static_cast<int>(shared_size - tile_.shared_offset));
          nodes.node = nodes_.lower_bound(x, y, z);
          tile_.runs.push_back(nodes);
          if (!shared) return;
          parts.push_back({nodes.node, count, shared_size});
          shared_size += 3 * static_cast<std::size_t>(count);
        });
  }

  void list_edges(int y, int z) {
    const auto brick = [&](int x, int row, int layer) { return box_.inside(x, row, layer); };
    list([&](int x) { return brick(x, y - 1, z - 1) + brick(x, y, z - 1) + brick(x, y - 1, z) + brick(x, y, z); });
    list([&](int x) { return brick(x - 1, y, z - 1) + brick(x, y, z - 1) + brick(x - 1, y, z) + brick(x, y, z); });
    list([&](int x) { return brick(x - 1, y - 1, z) + brick(x, y - 1, z) + brick(x - 1, y, z) + brick(x, y, z); });
  }

  void list_bricks(int y, int z) {
    close_list();
    each_run([&](int x) { return box_.inside(x, y, z) > 0; },
             [&](int x, int count) {
               tile_.runs.push_back(run(x, count, static_cast<int>(tile_.shares.size())));
               for (const Cell& below : {Cell(0, 0, 0), Cell(0, 0, 1), Cell(0, 1, 0), Cell(1, 0, 0)}) {
                 for (int i = x; i < x + count; ++i) {
                   const double other = below.isZero() ? 0 : box_.at(i - below.x(), y - below.y(), z - below.z());
                   tile_.shares.push_back(box_.at(i, y, z) + other);
                 }
                 pad();
               }
             });
  }

  /// Faces on the high side of a brick where no brick follows.
  void list_faces(int y, int z) {
    const auto last = [&](int x, const Cell& below) {
      return box_.at(x, y, z) > 0 ? 0.0 : box_.inside(x - below.x(), y - below.y(), z - below.z());
    };
    list([&](int x) { return last(x, {0, 0, 1}); });
    list([&](int x) { return last(x, {0, 1, 0}); });
    list([&](int x) { return last(x, {1, 0, 0}); });
  }

  const ShareBox& box_;
  const RowIndex& nodes_;
  Cell body_low_;
  Cell body_high_;
  BrickTile tile_;
};

struct Box {
  Cell low;
  Cell high;
};

/// The box of lattice cells cut into equal parts that are no larger than kTileSize; those without bricks left out.
std::vector<Box> cut(const RowIndex& bricks) {
  const Cell& low = bricks.low();
  const Cell size = bricks.high() + Cell::Ones() - low;
  const Cell counts = (size + kTileSize - Cell::Ones()).cwiseQuotient(kTileSize);
  const auto border = [&](const Cell& index) { return Cell(low + index.cwiseProduct(size).cwiseQuotient(counts)); };
  std::vector<Box> boxes;
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x) {
        const Box box{border({x, y, z}), border({x + 1, y + 1, z + 1})};
        if (bricks.has_any(box.low, box.high)) boxes.push_back(box);
      }
    }
  }
  return boxes;
}

/// Parts that overlap become one list of nodes to sum.
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

}  // namespace

BrickTiles make_brick_tiles(const BrickGrid& grid, const std::vector<double>& stiffness_scale) {
  BrickTiles result;
  if (grid.cells.empty()) return result;
  const RowIndex bricks(grid.cells);
  const RowIndex nodes(grid.lattice);
  const Cell& low = bricks.low();
  const Cell high = bricks.high() + Cell::Ones();
  for (const auto& [from, to] : cut(bricks)) {
    const ShareBox box(bricks, stiffness_scale, from, to);
    result.tiles.push_back(TileMaker(box, nodes, low, high).make(result.parts, result.shared_size));
    const auto size = static_cast<std::size_t>(scratch_size(result.tiles.back().rows));
    result.scratch_size = std::max(result.scratch_size, size);
  }
  join_parts(result);
  return result;
}

}  // namespace sprung
