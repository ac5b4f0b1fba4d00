#include "app/load/part_bricks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/mesh/query/thickness.h"

namespace sprung {
namespace {

constexpr double kAcrossAxis = 0.9999;  // of a normal, along an axis
constexpr double kFewestAlong = 8;      // bricks of the coarsest grid, along the longest side
constexpr double kSurfaceBricks = 0.6;  // bricks per brick-sized square of the surface, besides those of the volume
constexpr int kSizesTried = 300;        // in a range
constexpr double kWorthOfSize = 0.001;  // of a size twice as far from the goal, in squared bricks

/// A plane normal to an axis that contains flat faces, above the low end of their solid's lattice.
struct FlatFace {
  double height;  // m
  double weight;  // root of their area, m: small ones count too
};

std::vector<FlatFace> flat_faces_of(const LoadedBody& loaded) {
  constexpr double kSameHeight = 1e-6;  // of the longest side
  const double rounding = kSameHeight * loaded.extent.maxCoeff();
  std::map<std::tuple<std::size_t, Eigen::Index, long>, FlatFace> found;  // by solid, axis and height
  for (std::size_t row = 0; row < loaded.solids.size(); ++row) {
    const Solid& solid = loaded.solids[row];
    const Vec3 low = solid.points.colwise().minCoeff();
    for (const auto& corners : solid.triangles.rowwise()) {
      const Vec3 a = solid.points.row(corners[0]);
      const Vec3 b = solid.points.row(corners[1]);
      const Vec3 c = solid.points.row(corners[2]);
      const Vec3 area = (b - a).cross(c - a) / 2;
      Eigen::Index axis = 0;
      const double across = area.cwiseAbs().maxCoeff(&axis);
      if (!(across > kAcrossAxis * area.norm())) continue;
      const double height = a[axis] - low[axis];
      const auto [entry, is_new] =
          found.try_emplace({row, axis, std::lround(height / rounding)}, FlatFace{.height = height, .weight = 0});
      entry->second.weight += across;
    }
  }
  std::vector<FlatFace> faces;
  faces.reserve(found.size());
  for (const auto& [key, face] : found) faces.push_back({.height = face.height, .weight = std::sqrt(face.weight)});
  return faces;
}

/// Mean squared distance of the faces from faces of bricks, in bricks; 0 without faces.
double misfit(const std::vector<FlatFace>& faces, double size) {
  double sum = 0;
  double weights = 0;
  for (const FlatFace& face : faces) {
    const double bricks = face.height / size;
    sum += face.weight * std::pow(bricks - std::round(bricks), 2);
    weights += face.weight;
  }
  return weights > 0 ? sum / weights : 0;
}

/// The size between `low` and `high` that fits best, near `goal` if others fit as well.
double best_size(const std::vector<FlatFace>& faces, double low, double high, double goal) {
  double best = goal;
  double least = 1e300;
  for (int i = 0; i <= kSizesTried; ++i) {
    const double size = low * std::pow(high / low, double(i) / kSizesTried);
    const double cost = misfit(faces, size) + kWorthOfSize * std::abs(std::log2(size / goal));
    if (cost >= least) continue;
    least = cost;
    best = size;
  }
  return best;
}

/// Sizes at which a whole number of bricks fits into some height, which a sweep of sizes only comes near to.
double snapped(const std::vector<FlatFace>& faces, double size) {
  double best = size;
  double least = misfit(faces, size);
  for (const FlatFace& face : faces) {
    const double count = std::round(face.height / size);
    if (count < 1) continue;
    const double near = face.height / count;
    const double cost = misfit(faces, near);
    if (std::abs(near / size - 1) > 0.02 || cost >= least) continue;
    least = cost;
    best = near;
  }
  return best;
}

void add_coarser(const std::vector<FlatFace>& faces, double longest, PartBricks& bricks) {
  const double finest = bricks.sizes.front();
  for (const double ratio : {std::sqrt(2.0), 2.0}) {
    const double goal = std::min(ratio * finest, longest / kFewestAlong);
    const double size = snapped(faces, best_size(faces, 0.92 * goal, 1.1 * goal, goal));
    if (size > 1.15 * bricks.sizes.back()) bricks.sizes.push_back(size);
  }
}

double thickness_of(const LoadedBody& loaded) { return thickness_quantile(loaded.walls, 0.05); }

}  // namespace

PartBricks choose_part_bricks(const LoadedBody& loaded, double most) {
  double volume = 0;
  double area = 0;
  for (const Solid& solid : loaded.solids) {
    volume += solid.volume;
    area += surface_area(solid);
  }
  const double longest = loaded.extent.maxCoeff();
  const auto count = [&](double size) { return (volume / size + kSurfaceBricks * area) / (size * size); };
  double least = longest / kFewestAlong / 2;
  while (count(least) < most) least /= 1.01;
  PartBricks bricks{.sizes = {}, .thickness = thickness_of(loaded), .is_chosen = true};
  double goal = least;
  if (bricks.thickness > 0) goal = std::max(least, std::min(bricks.thickness / kBricksAcross, longest / 40));
  const std::vector<FlatFace> faces = flat_faces_of(loaded);
  bricks.sizes = {snapped(faces, best_size(faces, std::max(least, 0.7 * goal), 1.4 * goal, goal))};
  add_coarser(faces, longest, bricks);
  return bricks;
}

PartBricks part_bricks_from(const LoadedBody& loaded, double finest) {
  PartBricks bricks{.sizes = {finest}, .thickness = thickness_of(loaded)};
  add_coarser(flat_faces_of(loaded), loaded.extent.maxCoeff(), bricks);
  return bricks;
}

}  // namespace sprung
