#include "core/bricks/pieces.h"

#include <algorithm>
#include <numeric>

#include "core/bricks/neighbours.h"
#include "core/bricks/piece_links.h"
#include "core/bricks/piece_list.h"

namespace sprung {
namespace {

/// Where the solid of a piece is, for those who look for its brick.
SolidPatch patch_of(const PieceList& list, int piece, int row) {
  const int brick = list.brick_of(piece);
  const CutCell& cell = *list.cut(brick);
  const Eigen::Vector3i& at = list.grid().cells[static_cast<std::size_t>(brick)];
  SolidPatch patch{.cell = at, .brick = row, .samples = {}, .spots = {}};
  for (std::size_t sample = 0; sample < cell.piece.size(); ++sample) {
    if (list.at(brick, static_cast<int>(sample)) != piece) continue;
    if (sample < patch.samples.size()) {
      patch.samples.set(sample);
    } else {
      const Vec3 place = list.samples().place_of(cell, static_cast<int>(sample));
      patch.spots.emplace_back((place - at.cast<double>()).cast<float>());
    }
  }
  return patch;
}

/// Specks that no sample is in.
bool is_unseen(const PieceList& list, int brick) {
  const CutCell* cell = list.cut(brick);
  return cell == nullptr ? !list.is_whole(brick) : cell->weights.empty();
}

/// A brick for each piece; `unseen` by brick.
BrickGrid rebuilt(const PieceList& list, PieceLinks& links, std::vector<bool>& unseen) {
  BrickGrid grid;
  grid.origin = list.grid().origin;
  grid.brick_size = list.grid().brick_size;
  std::vector<int> row(list.pieces().size(), -1);
  for (int piece = 0; piece < list.count(); ++piece) {
    const auto [brick, fill] = list.pieces()[static_cast<std::size_t>(piece)];
    int& first = row[static_cast<std::size_t>(links.same_brick[static_cast<std::size_t>(piece)])];
    if (first < 0) {
      first = grid.brick_count();
      grid.cells.push_back(list.grid().cells[static_cast<std::size_t>(brick)]);
      grid.fill.push_back(0);
      unseen.push_back(is_unseen(list, brick));
    }
    row[static_cast<std::size_t>(piece)] = first;
    grid.fill[static_cast<std::size_t>(first)] += fill;
    if (list.cut(brick) != nullptr) grid.patches.push_back(patch_of(list, piece, first));
  }
  DisjointSets corners(8 * grid.cells.size());
  const auto of_brick = [&](int corner) { return 8 * row[static_cast<std::size_t>(corner / 8)] + corner % 8; };
  for (int corner = 0; corner < 8 * list.count(); ++corner) {
    corners.merge(of_brick(corner), of_brick(links.corners.find(corner)));
  }
  number_nodes(grid, corners);
  return grid;
}

/// The solid of unseen bricks goes to the fullest one beside each: nothing tells what else they hang together with.
void give_away(const std::vector<bool>& unseen, BrickGrid& grid) {
  const CellIndex index(grid);
  std::vector<bool> gone(grid.cells.size(), false);
  std::vector<int> heir(grid.cells.size(), -1);
  const std::vector<double> fill = grid.fill;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (!unseen[i]) continue;
    for (const int other : face_neighbours(grid, index, i)) {
      const auto row = static_cast<std::size_t>(other);
      if (other < 0 || unseen[row]) continue;
      if (heir[i] < 0 || fill[row] > fill[static_cast<std::size_t>(heir[i])]) heir[i] = other;
    }
    if (heir[i] < 0) continue;
    gone[i] = true;
    grid.fill[static_cast<std::size_t>(heir[i])] += fill[i];
  }
  remove_bricks(grid, gone, heir);
}

/// What hangs together with nothing, by its size.
void drop_specks(BrickGrid& grid, PieceReport& report) {
  DisjointSets sets(grid.lattice.size());
  for (const auto& nodes : grid.nodes) {
    for (const int node : nodes) sets.merge(nodes[0], node);
  }
  std::vector<double> volume(grid.lattice.size(), 0);
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    volume[static_cast<std::size_t>(sets.find(grid.nodes[i][0]))] += grid.fill[i];
  }
  const double sum = std::accumulate(grid.fill.begin(), grid.fill.end(), 0.0);
  std::vector<bool> gone(grid.cells.size(), false);
  double lost = 0;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (volume[static_cast<std::size_t>(sets.find(grid.nodes[i][0]))] >= kSpeckShare * sum) continue;
    gone[i] = true;
    ++report.dropped;
    lost += grid.fill[i];
  }
  report.floating =
      static_cast<int>(std::count_if(volume.begin(), volume.end(), [&](double v) { return v >= kSpeckShare * sum; })) -
      1;
  if (report.dropped == 0) return;
  report.dropped_volume = lost * grid.brick_volume();
  std::erase_if(grid.patches, [&](const SolidPatch& patch) { return gone[static_cast<std::size_t>(patch.brick)]; });
  remove_bricks(grid, gone, std::vector<int>(gone.size(), 0));
  for (double& fill : grid.fill) fill *= sum / (sum - lost);
}

Eigen::Vector3i counts_of(const BrickGrid& grid) {
  Eigen::Vector3i counts = Eigen::Vector3i::Ones();
  for (const Eigen::Vector3i& cell : grid.cells) counts = counts.cwiseMax(cell + Eigen::Vector3i::Ones());
  return counts;
}

}  // namespace

PieceReport split_pieces(const Solid& solid, BrickGrid& grid) {
  // What follows lines through the solid needs a surface that they enter as often as they leave it.
  if (grid.cells.empty() || !solid.closed || solid.thickness > 0) return {};
  const Eigen::Vector3i counts = counts_of(grid);
  Points points = (solid.points.rowwise() - grid.origin.transpose()) / grid.brick_size;
  for (int axis = 0; axis < 3; ++axis) points.col(axis) = points.col(axis).cwiseMax(0.0).cwiseMin(counts[axis]);
  const CellSurface surface{std::move(points), solid.triangles, counts};
  const PieceList list(surface, grid);
  PieceLinks links = link_pieces(list);
  PieceReport report{.divided = list.divided(), .attached = links.attached};
  std::vector<bool> unseen;
  grid = rebuilt(list, links, unseen);
  give_away(unseen, grid);
  drop_specks(grid, report);
  return report;
}

}  // namespace sprung
