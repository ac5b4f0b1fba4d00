#include "core/bricks/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bricks/embedding.h"
#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr int kFewestBricks = 4;  // in a part
constexpr double kThicknessRounding = 1e-6;

using Lists = std::vector<std::vector<int>>;

/// The samples in each brick.
Lists samples_by_brick(const BrickGrid& grid, const std::vector<WallSample>& samples) {
  Points positions(samples.size(), 3);
  Points normals(positions.rows(), 3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    positions.row(i) = samples[i].position;
    normals.row(i) = samples[i].outward;
  }
  const Embedding embedding = embed(grid, positions, normals);
  Lists lists(grid.cells.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    lists[embedding.brick[i]].push_back(int(i));
  }
  return lists;
}

/// Over the samples of the bricks around each of a brick's nodes; infinite without samples.
std::vector<double> median_thickness(const BrickGrid& grid, const std::vector<WallSample>& samples,
                                     const Lists& in_brick) {
  Lists at_node(grid.lattice.size());
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    for (const int node : grid.nodes[brick]) {
      std::vector<int>& list = at_node[node];
      list.insert(list.end(), in_brick[brick].begin(), in_brick[brick].end());
    }
  }
  std::vector<double> medians(grid.cells.size(), std::numeric_limits<double>::infinity());
  std::vector<double> pool;
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    pool.clear();
    for (const int node : grid.nodes[brick]) {
      for (const int sample : at_node[node]) {
        pool.push_back(samples[sample].thickness);
      }
    }
    if (pool.empty()) continue;
    const auto middle = pool.begin() + std::ptrdiff_t(pool.size() / 2);
    std::nth_element(pool.begin(), middle, pool.end());
    medians[brick] = *middle;
  }
  return medians;
}

/// The thinnest point is where the median thickness around a brick is smallest, since a few samples at a sharp edge
/// mean nothing.
ThinPart measured(std::vector<int> bricks, const std::vector<double>& medians, const std::vector<WallSample>& samples,
                  const Lists& in_brick, double brick_size) {
  ThinPart part{.bricks = std::move(bricks), .thickness = std::numeric_limits<double>::infinity()};
  for (const int brick : part.bricks) {
    const std::size_t row = brick;
    if (medians[row] >= part.thickness || in_brick[row].empty()) continue;
    part.thickness = medians[row];
    part.position = samples[in_brick[row].front()].position;
  }
  part.across = part.thickness / brick_size;
  return part;
}

}  // namespace

std::vector<ThinPart> find_thin_parts(const BrickGrid& grid, const std::vector<WallSample>& samples) {
  const Lists in_brick = samples_by_brick(grid, samples);
  const std::vector<double> medians = median_thickness(grid, samples, in_brick);
  const auto is_thin = [&](std::size_t brick) { return medians[brick] < (1 - kThicknessRounding) * grid.brick_size; };
  DisjointSets sets(grid.lattice.size());
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    for (const int node : grid.nodes[brick]) {
      if (is_thin(brick)) sets.merge(grid.nodes[brick][0], node);
    }
  }
  Lists groups(grid.lattice.size());
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    if (is_thin(brick)) {
      groups[sets.find(grid.nodes[brick][0])].push_back(int(brick));
    }
  }
  const auto least = std::size_t(std::min(kFewestBricks, grid.brick_count()));
  std::vector<ThinPart> parts;
  for (std::vector<int>& group : groups) {
    if (group.size() < least) continue;
    parts.push_back(measured(std::move(group), medians, samples, in_brick, grid.brick_size));
  }
  std::erase_if(parts, [](const ThinPart& part) { return !std::isfinite(part.thickness); });
  std::stable_sort(parts.begin(), parts.end(),
                   [](const ThinPart& a, const ThinPart& b) { return a.thickness < b.thickness; });
  return parts;
}

namespace {

constexpr double kCounts = 0.05;        // of the surface: thinner parts are irrelevant
constexpr double kBricksAcross = 2;     // the thinnest relevant part
constexpr double kFewestAlong = 12;     // the longest side
constexpr double kSurfaceBricks = 0.6;  // bricks per brick-sized square of the surface, besides those of the volume

}  // namespace

BrickChoice choose_brick_size(const std::vector<Solid>& solids, const std::vector<std::vector<WallSample>>& walls,
                              double longest, double budget) {
  double volume = 0;
  double area = 0;
  for (const Solid& solid : solids) {
    volume += solid.volume;
    area += surface_area(solid);
  }
  BrickChoice choice;
  choice.thickness = thickness_quantile(walls, kCounts);
  choice.size = choice.thickness / kBricksAcross;
  if (choice.thickness == 0 || choice.size > longest / kFewestAlong) {
    choice.size = longest / kFewestAlong;
    choice.reason = BrickChoice::Reason::kShape;
  }
  const auto bricks = [&](double size) { return (volume / size + kSurfaceBricks * area) / (size * size); };
  if (bricks(choice.size) > budget) {
    choice.reason = BrickChoice::Reason::kBudget;
    while (bricks(choice.size) > budget) choice.size *= 1.01;
  }
  choice.across = choice.thickness / choice.size;
  return choice;
}

}  // namespace sprung
