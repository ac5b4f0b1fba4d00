#include "core/bricks/solid_finder.h"

#include <limits>

namespace sprung {
namespace {

constexpr double kNudge = 1e-3;  // bricks inward, so that a point on a face is in the cell of its solid
constexpr double kOutward = 16;  // how much more than a way inward a way outward costs
constexpr double kNear = 0.25;   // bricks: solid this near in the point's own cell is taken without a look around

std::vector<Eigen::Vector3i> cells_of(const std::vector<SolidPatch>& patches) {
  std::vector<Eigen::Vector3i> cells;
  cells.reserve(patches.size());
  for (const SolidPatch& patch : patches) cells.push_back(patch.cell);
  return cells;
}

double cost_of(const Vec3& way, const Vec3& inward) {
  const double along = way.dot(inward);
  return way.squaredNorm() + (along < 0 ? kOutward * along * along : 0);
}

double cost_to(const SolidPatch& patch, const Vec3& place, const Vec3& inward) {
  double least = std::numeric_limits<double>::infinity();
  const Vec3 local = place - patch.cell.cast<double>();
  for (std::size_t i = patch.samples._Find_first(); i < patch.samples.size(); i = patch.samples._Find_next(i)) {
    const Vec3 sample =
        (Vec3(static_cast<double>(i & 7), static_cast<double>(i >> 3 & 7), static_cast<double>(i >> 6)).array() + 0.5) /
        8;
    least = std::min(least, cost_of(sample - local, inward));
  }
  for (const Eigen::Vector3f& spot : patch.spots) least = std::min(least, cost_of(spot.cast<double>() - local, inward));
  return least;
}

}  // namespace

SolidFinder::SolidFinder(const BrickGrid& grid) : grid_(grid), bricks_(grid.cells), patches_(cells_of(grid.patches)) {}

void SolidFinder::consider(const Eigen::Vector3i& cell, const Vec3& place, const Vec3& inward, Nearest& nearest) const {
  const auto offer = [&](int brick, double cost) {
    if (cost < nearest.cost) nearest = {brick, cost};
  };
  const int first = patches_.at(cell);
  if (first < 0) {
    const int brick = bricks_.at(cell);
    const Vec3 low = cell.cast<double>();
    if (brick >= 0) offer(brick, cost_of(place.cwiseMax(low).cwiseMin(low + Vec3::Ones()) - place, inward));
    return;
  }
  for (auto i = static_cast<std::size_t>(first); i < grid_.patches.size() && grid_.patches[i].cell == cell; ++i) {
    offer(grid_.patches[i].brick, cost_to(grid_.patches[i], place, inward));
  }
}

int SolidFinder::under(const Vec3& place, const Vec3& inward) const {
  if (grid_.patches.empty()) return -1;
  const Eigen::Vector3i centre = (place + kNudge * inward).array().floor().cast<int>();
  Nearest nearest{.cost = std::numeric_limits<double>::infinity()};
  consider(centre, place, inward, nearest);
  if (nearest.cost <= kNear * kNear) return nearest.brick;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (i != 13) consider(centre + offset, place, inward, nearest);
  }
  return nearest.brick;
}

}  // namespace sprung
