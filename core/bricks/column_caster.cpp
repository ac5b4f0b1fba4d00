#include "core/bricks/column_caster.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sprung {
namespace {

// The rays of a cell form a rank-1 lattice, one in each of 16 rows at 16 different positions: an axis-aligned wall is
// then resolved at 16 levels instead of the 4 of a 4 x 4 grid.
constexpr std::int64_t kRays = 16;
constexpr std::int64_t kRayPitch = kSnap / kRays;
constexpr std::int64_t kShuffle = 5;

/// The weight of a direction whose rays do not cross the surface in a cell: decisive only if none do.
constexpr float kMinWeight = 1e-6F;

struct Intersection {
  std::int64_t ray;  // rays of one column of cells are consecutive
  double depth;      // cells from the low side of the box
  int turn;          // +1 entering, -1 leaving
};

/// A column of cells along the rays.
struct Column {
  std::vector<float> lengths;    // inside, summed over the rays
  std::vector<float> crossings;  // with the surface, within each cell
};

class Caster {
 public:
  Caster(const CellSurface& surface, int axis)
      : surface_(surface), axis_(axis), axis_u_((axis + 1) % 3), axis_v_((axis + 2) % 3) {}

  /// All crossings, ordered by ray and depth.
  std::vector<Intersection> crossings() {
    for (int t = 0; t < surface_.triangles.rows(); ++t) cross_triangle(t);
    sort_by_ray();
    return std::move(crossings_);
  }

  void add_sums(const std::vector<Intersection>& crossings, CellSums& sums) const {
    const std::size_t length = surface_.counts[axis_];
    Column column{std::vector<float>(length), std::vector<float>(length)};
    for (std::int64_t cell = 0, i = 0; cell < std::int64_t{surface_.counts[axis_u_]} * surface_.counts[axis_v_];
         ++cell) {
      std::fill(column.lengths.begin(), column.lengths.end(), 0.0F);
      std::fill(column.crossings.begin(), column.crossings.end(), 0.0F);
      auto at = std::size_t(i);
      while (at < crossings.size() && crossings[at].ray / kRays == cell) at = add_ray(crossings, at, column);
      i = static_cast<std::int64_t>(at);
      add_column(cell, column, sums);
    }
  }

 private:
  /// The position of the ray of row `row` in cell `cell_u` of that row.
  static SnappedPoint position_of(std::int64_t cell_u, std::int64_t row) {
    return {cell_u * kSnap + (row * kShuffle % kRays) * kRayPitch + kRayPitch / 2, row * kRayPitch + kRayPitch / 2};
  }

  [[nodiscard]] std::int64_t ray_number(std::int64_t cell_u, std::int64_t row) const {
    return ((row / kRays) * surface_.counts[axis_u_] + cell_u) * kRays + row % kRays;
  }

  void cross_triangle(int t) {
    const SnappedTriangle triangle(surface_, t, axis_);
    if (triangle.is_empty()) return;
    const auto [low_u, low_v] = triangle.low();
    const auto [high_u, high_v] = triangle.high();
    // Rows half a pitch or more outside the triangle's extent cannot meet it, and neither can cells outside it.
    const std::int64_t last_row = std::min<std::int64_t>(high_v / kRayPitch, surface_.counts[axis_v_] * kRays - 1);
    const std::int64_t last_cell = std::min<std::int64_t>(high_u / kSnap, surface_.counts[axis_u_] - 1);
    for (std::int64_t row = low_v / kRayPitch; row <= last_row; ++row) {
      for (std::int64_t cell = low_u / kSnap; cell <= last_cell; ++cell) {
        const std::optional<double> depth = triangle.depth_at(position_of(cell, row));
        if (depth) crossings_.push_back({ray_number(cell, row), *depth, triangle.turn()});
      }
    }
  }

  /// Counting sort by ray, then the few crossings of each ray by depth.
  void sort_by_ray() {
    const std::int64_t cells = std::int64_t{surface_.counts[axis_u_]} * surface_.counts[axis_v_];
    std::vector<std::size_t> next(std::size_t(cells * kRays) + 1, 0);
    for (const Intersection& crossing : crossings_) ++next[crossing.ray + 1];
    for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    std::vector<Intersection> sorted(crossings_.size());
    for (const Intersection& crossing : crossings_) sorted[next[crossing.ray]++] = crossing;
    crossings_.swap(sorted);
    const auto deeper = [](const Intersection& a, const Intersection& b) { return a.depth < b.depth; };
    for (std::size_t begin = 0, end = 0; begin < crossings_.size(); begin = end) {
      while (end < crossings_.size() && crossings_[end].ray == crossings_[begin].ray) ++end;
      std::stable_sort(crossings_.begin() + std::ptrdiff_t(begin), crossings_.begin() + std::ptrdiff_t(end), deeper);
    }
  }

  /// Adds one ray to its column of cells; returns where the next ray's crossings begin.
  static std::size_t add_ray(const std::vector<Intersection>& crossings, std::size_t begin, Column& column) {
    const std::int64_t ray = crossings[begin].ray;
    int winding = 0;
    std::size_t i = begin;
    for (; i < crossings.size() && crossings[i].ray == ray; ++i) {
      const double depth = crossings[i].depth;
      if (winding != 0) add_length(crossings[i - 1].depth, depth, column.lengths);
      winding += crossings[i].turn;
      // A crossing exactly between two cells counts for neither.
      if (const double cell = std::floor(depth); cell != depth) column.crossings[std::size_t(cell)] += 1.0F;
    }
    return i;
  }

  static void add_length(double from, double to, std::vector<float>& lengths) {
    const auto last = std::ptrdiff_t(lengths.size()) - 1;
    const std::ptrdiff_t first_cell = std::min(std::ptrdiff_t(from), last);
    const std::ptrdiff_t last_cell = std::min(std::ptrdiff_t(to), last);
    float* cells = lengths.data();
    if (first_cell == last_cell) {
      cells[first_cell] += float(to - from);
      return;
    }
    cells[first_cell] += float(double(first_cell + 1) - from);
    for (std::ptrdiff_t i = first_cell + 1; i < last_cell; ++i) cells[i] += 1.0F;
    cells[last_cell] += float(to - double(last_cell));
  }

  void add_column(std::int64_t cell, const Column& column, CellSums& sums) const {
    const std::array<std::int64_t, 3> strides{1, surface_.counts[0],
                                              std::int64_t{surface_.counts[0]} * surface_.counts[1]};
    const auto stride_of = [&](int axis) { return strides[axis]; };
    auto at = std::size_t(cell % surface_.counts[axis_u_] * stride_of(axis_u_) +
                          cell / surface_.counts[axis_u_] * stride_of(axis_v_));
    for (std::size_t i = 0; i < column.lengths.size(); ++i) {
      const float weight = column.crossings[i] * column.crossings[i] + kMinWeight;
      sums.weighted[at] += weight * column.lengths[i] / float(kRays);
      sums.weight[at] += weight;
      at += std::size_t(stride_of(axis_));
    }
  }

  const CellSurface& surface_;
  int axis_;
  int axis_u_;
  int axis_v_;
  std::vector<Intersection> crossings_;
};

}  // namespace

void cast_columns(const CellSurface& surface, int axis, CellSums& sums) {
  Caster caster(surface, axis);
  caster.add_sums(caster.crossings(), sums);
}

}  // namespace sprung
