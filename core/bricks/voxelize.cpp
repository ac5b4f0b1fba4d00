#include "core/bricks/voxelize.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/bricks/column_caster.h"
#include "core/error.h"
#include "core/mesh/query/winding_tree.h"

namespace sprung {
namespace {

constexpr int kBlock = 4;        // cells along a block's side
constexpr int kFillSamples = 4;  // along a cell's side
constexpr double kSure = 0.2;    // at this distance from 1/2 the winding number decides for a whole block

class Filler {
 public:
  Filler(const CellSurface& surface, CellSums& sums)
      : surface_(surface), sums_(sums), tree_(surface.points, surface.triangles), touched_(sums.weight.size(), 0) {
    for (int t = 0; t < surface.triangles.rows(); ++t) mark(t);
  }

  void fill_block(const Eigen::Vector3i& low) {
    const Eigen::Vector3i high = (low.array() + kBlock).min(surface_.counts.array());
    bool is_near = false;
    visit(low, high, [&](const Eigen::Vector3i&, std::size_t i) { is_near = is_near || touched_[i] != 0; });
    const double middle = winding(0.5 * (low + high).cast<double>());
    const bool is_sure = !is_near && std::abs(middle - 0.5) > kSure;
    visit(low, high, [&](const Eigen::Vector3i& cell, std::size_t i) {
      sums_.weight[i] = 1;
      sums_.weighted[i] = float(is_sure            ? (middle > 0.5 ? 1 : 0)
                                : touched_[i] != 0 ? sampled(cell)
                                                   : inside(cell.cast<double>().array() + 0.5));
    });
  }

 private:
  [[nodiscard]] std::size_t row_of(const Eigen::Vector3i& cell) const {
    return (std::size_t(cell.z()) * std::size_t(surface_.counts.y()) + std::size_t(cell.y())) *
               std::size_t(surface_.counts.x()) +
           std::size_t(cell.x());
  }

  template <class Visit>
  void visit(const Eigen::Vector3i& low, const Eigen::Vector3i& high, const Visit& call) const {
    for (int z = low.z(); z < high.z(); ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x) call(Eigen::Vector3i(x, y, z), row_of({x, y, z}));
      }
    }
  }

  /// Cells in the triangle's box that its plane cuts.
  void mark(int t) {
    const auto corner = [&](int k) -> Vec3 { return surface_.points.row(surface_.triangles(t, k)); };
    const Vec3 a = corner(0);
    const Vec3 b = corner(1);
    const Vec3 c = corner(2);
    const Vec3 normal = (b - a).cross(c - a);
    const double reach = 0.5 * normal.cwiseAbs().sum();
    const Eigen::Array3i low = a.cwiseMin(b).cwiseMin(c).array().floor().cast<int>();
    const Eigen::Array3i high = a.cwiseMax(b).cwiseMax(c).array().floor().cast<int>() + 1;
    visit(low.max(0), high.min(surface_.counts.array()), [&](const Eigen::Vector3i& cell, std::size_t i) {
      const Vec3 middle = cell.cast<double>().array() + 0.5;
      if (std::abs(normal.dot(middle - a)) <= reach) touched_[i] = 1;
    });
  }

  [[nodiscard]] double winding(const Vec3& position) const { return std::abs(tree_.at(position)); }
  [[nodiscard]] double inside(const Vec3& position) const { return winding(position) > 0.5 ? 1 : 0; }

  [[nodiscard]] double sampled(const Eigen::Vector3i& cell) const {
    double sum = 0;
    for (int i = 0; i < kFillSamples * kFillSamples * kFillSamples; ++i) {
      const Eigen::Array3i position(i % kFillSamples, i / kFillSamples % kFillSamples,
                                    i / (kFillSamples * kFillSamples));
      sum += inside(cell.cast<double>().array() + (position.cast<double>() + 0.5) / kFillSamples);
    }
    return sum / (kFillSamples * kFillSamples * kFillSamples);
  }

  const CellSurface& surface_;
  CellSums& sums_;
  WindingTree tree_;
  std::vector<std::uint8_t> touched_;
};

}  // namespace

void fill_by_winding(const CellSurface& surface, CellSums& sums) {
  Filler filler(surface, sums);
  const Eigen::Vector3i blocks = (surface.counts.array() + kBlock - 1) / kBlock;
  tbb::parallel_for(0, blocks.prod(), [&](int block) {
    const Eigen::Vector3i place(block % blocks.x(), block / blocks.x() % blocks.y(), block / (blocks.x() * blocks.y()));
    filler.fill_block(kBlock * place);
  });
}

namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

using Corners = std::array<Vec3, 3>;

double squared_distance_to_side(const Vec3& a, const Vec3& b, const Vec3& position) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((position - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + share * along - position).squaredNorm();
}

/// A triangle prepared for distance queries.
class Triangle {
 public:
  explicit Triangle(const Corners& corners) : corners_(corners) {
    normal_ = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (normal_.norm() > 0) normal_.normalize();
  }

  [[nodiscard]] double squared_distance(const Vec3& position) const {
    if (is_above(position)) {
      const double height = normal_.dot(position - corners_[0]);
      return height * height;
    }
    return std::min({squared_distance_to_side(corners_[0], corners_[1], position),
                     squared_distance_to_side(corners_[1], corners_[2], position),
                     squared_distance_to_side(corners_[2], corners_[0], position)});
  }

 private:
  [[nodiscard]] bool is_above(const Vec3& position) const {
    if (normal_.isZero(0)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = corners_[(k + 1) % 3] - corners_[k];
      if (normal_.cross(side).dot(position - corners_[k]) < 0) return false;
    }
    return true;
  }

  Corners corners_;
  Vec3 normal_;
};

/// Adds the samples of a cell within `reach` of the triangle to the known ones.
std::uint64_t near_samples(const Triangle& triangle, const Vec3& low, double reach, std::uint64_t known) {
  if (known == kAll) return known;
  const double half_diagonal = std::sqrt(3.0) / 2;
  const double middle = std::sqrt(triangle.squared_distance(low.array() + 0.5));
  if (middle > reach + half_diagonal) return known;
  if (middle < reach - half_diagonal) return kAll;
  for (int i = 0; i < kFillSamples * kFillSamples * kFillSamples; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((known & bit) != 0) continue;
    const Eigen::Array3i position(i % kFillSamples, i / kFillSamples % kFillSamples, i / (kFillSamples * kFillSamples));
    if (triangle.squared_distance(low.array() + (position.cast<double>() + 0.5) / kFillSamples) <= reach * reach)
      known |= bit;
  }
  return known;
}

}  // namespace

void fill_shell(const CellSurface& surface, double thickness, CellSums& sums) {
  // A little more than half, so that samples in line with a face of the shell do not depend on rounding.
  constexpr double kMargin = 1e-6;
  const double sampled = std::max(1.0, thickness);
  const double reach = sampled / 2 + kMargin;
  std::vector<std::uint64_t> samples(sums.weight.size(), 0);
  for (const auto& row : surface.triangles.rowwise()) {
    const Corners corners{surface.points.row(row[0]), surface.points.row(row[1]), surface.points.row(row[2])};
    const Triangle triangle(corners);
    const Vec3 lowest = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).array() - reach;
    const Vec3 highest = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]).array() + reach;
    const Eigen::Array3i low = lowest.array().floor().cast<int>().max(0);
    const Eigen::Array3i high = (highest.array().floor().cast<int>() + 1).min(surface.counts.array());
    for (int z = low.z(); z < high.z(); ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x) {
          const auto cell = std::size_t(x) + std::size_t(surface.counts.x()) *
                                                 (std::size_t(y) + std::size_t(surface.counts.y()) * std::size_t(z));
          samples[cell] = near_samples(triangle, Vec3(x, y, z), reach, samples[cell]);
        }
      }
    }
  }
  const double share = thickness / sampled / (kFillSamples * kFillSamples * kFillSamples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sums.weight[i] = 1;
    sums.weighted[i] = float(share * std::popcount(samples[i]));
  }
}

namespace {

/// Lengths this near a whole number of bricks, relatively, are that number, since file formats round to float.
constexpr double kWhole = 1e-6;
/// Fills nearer than this to 0 or 1 are rounded.
constexpr double kSliver = 1e-6;
/// The largest relative error of the sampled volume by sampling alone; more means an overlap.
constexpr double kSamplingError = 0.005;

/// Rounds `cells` where it is a whole number up to rounding errors in a box of `count` cells.
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
    if (!(count <= kMaxCellsPerAxis) || product > std::numeric_limits<std::int32_t>::max()) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("bricks of {:.6g} are too small for a body of {:.6g} x {:.6g} x {:.6g}: the box would be "
                              "more than {} bricks long or hold more than 2^31; use larger bricks",
                              brick_size, extent.x(), extent.y(), extent.z(), kMaxCellsPerAxis));
    }
    counts[axis] = int(count);
  }
  return counts;
}

/// The solid's points in units of cells; faces on a lattice plane up to rounding errors are snapped to it.
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
        const double share = double(sums.weighted[i]) / double(sums.weight[i]);
        if (share < kSliver) continue;
        grid.cells.emplace_back(x, y, z);
        grid.fill.push_back(share > 1 - kSliver ? 1.0 : share);
      }
    }
  }
}

/// Scales the fill of partly filled bricks by one factor, but none beyond 1, to make the volume `volume`. Changes
/// nothing if the difference is more than sampling error.
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

/// A shell thinner than a brick is sampled as if it were one brick thick, and so extends too far at its rims.
void scale_fill(double factor, BrickGrid& grid) {
  for (double& fill : grid.fill) fill = std::min(1.0, fill * factor);
}

/// Rays along one axis may miss a wall thinner than their pitch; those along the other axes do not.
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

  const std::size_t cells = counts.cast<std::int64_t>().prod();
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
  constexpr double kCellsByWinding = 48;  // slower, but accurate to 1e-3
  if (solid.thickness > 0 || (solid.closed && !solid.overlaps)) return solid.volume;
  const Vec3 extent = solid.points.colwise().maxCoeff() - solid.points.colwise().minCoeff();
  return voxelize(solid, extent.maxCoeff() / (solid.closed ? kCells : kCellsByWinding)).volume();
}

}  // namespace sprung
