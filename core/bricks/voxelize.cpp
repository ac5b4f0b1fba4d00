#include "core/bricks/voxelize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/bricks/column_caster.h"
#include "core/bricks/shell_cells.h"
#include "core/bricks/winding_cells.h"
#include "core/error.h"

namespace sprung {
namespace {

/// A length this near a whole number of bricks, relative to the length, is that number: file formats round to float.
constexpr double kWhole = 1e-6;
/// Fills nearer than this to 0 or 1 are 0 or 1.
constexpr double kSliver = 1e-6;
/// The sampled volume may differ from the mesh's by this share through sampling alone; more means an overlap.
constexpr double kSamplingError = 0.005;

/// The nearest whole number where `cells` is one up to rounding in a box of `count` cells.
double without_rounding(double cells, double count) {
  const double whole = std::round(cells);
  return std::abs(cells - whole) <= kWhole * count ? whole : cells;
}

Eigen::Vector3i count_cells(const Vec3& extent, double brick_size) {
  double product = 1;
  Eigen::Vector3i counts;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = extent[axis] / brick_size;
    const double count = std::max(1.0, std::ceil(without_rounding(length, std::max(1.0, length))));
    product *= count;
    if (!(count <= kMostCellsPerAxis) || product > std::numeric_limits<std::int32_t>::max()) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("bricks of {:.6g} are too small for a body of {:.6g} x {:.6g} x {:.6g}: the box would be "
                              "more than {} bricks long or hold more than 2^31; use larger bricks",
                              brick_size, extent.x(), extent.y(), extent.z(), kMostCellsPerAxis));
    }
    counts[axis] = static_cast<int>(count);
  }
  return counts;
}

/// The solid's points in units of cells; faces that lie on a lattice plane up to rounding are put on it.
Points in_cells(const Points& points, const Vec3& low, const Vec3& high, const Eigen::Vector3i& counts,
                double brick_size) {
  Points cells(points.rows(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const double count = counts[axis];
    const double length = (high[axis] - low[axis]) / brick_size;
    const double stretch = without_rounding(length, count) == count ? count / length : 1.0;
    for (int p = 0; p < points.rows(); ++p) {
      const double place = (points(p, axis) - low[axis]) / brick_size * stretch;
      cells(p, axis) = std::clamp(without_rounding(place, count), 0.0, count);
    }
  }
  return cells;
}

void collect_cells(const CellSums& sums, const Eigen::Vector3i& counts, BrickGrid& grid) {
  std::size_t i = 0;
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x, ++i) {
        const double share = static_cast<double>(sums.weighted[i]) / static_cast<double>(sums.weight[i]);
        if (share < kSliver) continue;
        grid.cells.emplace_back(x, y, z);
        grid.fill.push_back(share > 1 - kSliver ? 1.0 : share);
      }
    }
  }
}

/// Scales the fill of the partly filled bricks by one factor, none beyond 1, so that the volume becomes `volume`.
/// Leaves everything as it is where the difference is more than sampling explains.
void match_volume(double volume, BrickGrid& grid) {
  const double target = volume / grid.brick_volume();
  for (int pass = 0; pass < 8; ++pass) {
    double whole = 0;
    double partial = 0;
    for (const double fill : grid.fill) (fill < 1 ? partial : whole) += fill;
    const double missing = target - whole - partial;
    if (std::abs(missing) > kSamplingError * target || std::abs(missing) > 0.5 * partial) return;
    if (std::abs(missing) <= 1e-14 * target) return;
    const double factor = 1 + missing / partial;
    for (double& fill : grid.fill) {
      if (fill < 1) fill = std::min(1.0, fill * factor);
    }
  }
}

/// A shell thinner than a brick is found as if it were one thick, and reaches further than it does at its rims.
void scale_fill(double factor, BrickGrid& grid) {
  for (double& fill : grid.fill) fill = std::min(1.0, fill * factor);
}

/// Rays along one axis may miss a wall between them that is thinner than their pitch; those of the other axes do not.
void fill_columns(const CellSurface& surface, CellSums& sums) {
  for (int axis = 0; axis < 3; ++axis) cast_columns(surface, axis, sums);
}

}  // namespace

BrickGrid voxelize(const Solid& solid, double brick_size) {
  const double beyond = solid.thickness > 0 ? std::max(solid.thickness, brick_size) / 2 : 0;
  const Vec3 low = solid.points.colwise().minCoeff().array() - beyond;
  const Vec3 high = solid.points.colwise().maxCoeff().array() + beyond;
  const Eigen::Vector3i counts = count_cells(high - low, brick_size);
  const CellSurface surface{in_cells(solid.points, low, high, counts, brick_size), solid.triangles, counts};

  const auto cells = static_cast<std::size_t>(counts.cast<std::int64_t>().prod());
  CellSums sums{std::vector<float>(cells, 0.0F), std::vector<float>(cells, 0.0F)};
  if (solid.thickness > 0) {
    fill_shell(surface, solid.thickness / brick_size, sums);
  } else if (solid.closed) {
    fill_columns(surface, sums);
  } else {
    fill_by_winding(surface, sums);
  }

  BrickGrid grid;
  grid.origin = low;
  grid.brick_size = brick_size;
  collect_cells(sums, counts, grid);
  if (solid.thickness > 0 && solid.thickness < brick_size) scale_fill(solid.volume / grid.volume(), grid);
  if (solid.thickness == 0 && solid.closed && !solid.overlaps) match_volume(solid.volume, grid);
  number_nodes(grid);
  return grid;
}

double enclosed_volume(const Solid& solid) {
  constexpr double kCells = 128;
  constexpr double kCellsByWinding = 48;  // that is slow, and exact to 1e-3 so
  if (solid.thickness > 0 || (solid.closed && !solid.overlaps)) return solid.volume;
  const Vec3 extent = solid.points.colwise().maxCoeff() - solid.points.colwise().minCoeff();
  return voxelize(solid, extent.maxCoeff() / (solid.closed ? kCells : kCellsByWinding)).volume();
}

}  // namespace sprung
