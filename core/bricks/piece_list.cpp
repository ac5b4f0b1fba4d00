#include "core/bricks/piece_list.h"

#include <numeric>

namespace sprung {
namespace {

constexpr double kHalf = 0.5;  // a cell that no line crosses the surface in is whole from this fill on, else empty

}  // namespace

PieceList::PieceList(const CellSurface& surface, const BrickGrid& grid) : grid_(grid), samples_(surface, grid) {
  for (int brick = 0; brick < grid_.brick_count(); ++brick) {
    first_.push_back(count());
    const double fill = grid_.fill[static_cast<std::size_t>(brick)];
    const CutCell* cell = cut(brick);
    if (cell == nullptr || cell->weights.size() < 2) {
      pieces_.push_back({brick, fill});
      continue;
    }
    ++divided_;
    const double sum = std::accumulate(cell->weights.begin(), cell->weights.end(), 0.0);
    for (const float weight : cell->weights) pieces_.push_back({brick, fill * static_cast<double>(weight) / sum});
  }
  first_.push_back(count());
}

const CutCell* PieceList::cut(int brick) const {
  const int cell = samples_.cut_cell_of(brick);
  return cell < 0 ? nullptr : &samples_.cut_cells()[static_cast<std::size_t>(cell)];
}

bool PieceList::is_whole(int brick) const {
  return cut(brick) == nullptr && grid_.fill[static_cast<std::size_t>(brick)] >= kHalf;
}

int PieceList::at(int brick, int sample) const {
  const CutCell* cell = cut(brick);
  if (cell == nullptr) return is_whole(brick) ? first(brick) : -1;
  const int number = cell->piece[static_cast<std::size_t>(sample)];
  return number == 0 ? -1 : first(brick) + number - 1;
}

int PieceList::beside(int brick, const Eigen::Vector3i& offset) const {
  return samples_.brick_at(grid_.cells[static_cast<std::size_t>(brick)] + offset);
}

std::vector<PieceItem> PieceList::items(int brick) const {
  std::vector<PieceItem> items;
  const CutCell* cell = cut(brick);
  const CutCell whole{.brick = brick, .spots = {}, .piece = {}, .weights = {}};
  const int samples = static_cast<int>(whole.lines.size() + (cell == nullptr ? 0 : cell->spots.size()));
  for (int sample = 0; sample < samples; ++sample) {
    const int piece = at(brick, sample);
    if (piece >= 0) items.push_back({samples_.place_of(cell == nullptr ? whole : *cell, sample), piece});
  }
  return items;
}

}  // namespace sprung
