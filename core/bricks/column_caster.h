#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/types.h"

namespace sprung {

/// A closed surface in units of cells, inside the box of `counts` cells that starts at 0.
struct CellSurface {
  Points points;  // p x 3, in [0, counts]
  const Triangles& triangles;
  Eigen::Vector3i counts;
};

/// The most cells along one axis for which the caster's integer arithmetic is exact.
inline constexpr int kMaxCellsPerAxis = 1 << 16;

/// Estimates of each cell's fill by rays along the axes; x fastest, then y, then z.
struct CellSums {
  std::vector<float> weighted;  // sum over the axes of weight x fraction of the cell inside
  std::vector<float> weight;  // sum over the axes: the more a direction's rays cross the surface in a cell, the better
                              // they measure it; rays along a flat wall hardly count
};

/// Adds the estimates of rays along `axis` to `sums`: 16 rays per cell, with exact lengths inside. Inside is where the
/// winding number is not 0. Rays and edges are compared in integers with one rule for ties, so that every ray enters as
/// often as it leaves, even along a face or through an edge.
void cast_columns(const CellSurface& surface, int axis, CellSums& sums);

inline constexpr std::int64_t kSnap = 4096;  // integer steps per cell, across the lines

/// The position of a line along an axis: u along the next axis, v along the one after it, in steps of 1 / kSnap cells.
struct SnappedPoint {
  std::int64_t u;
  std::int64_t v;
};

/// A triangle projected along an axis. Lines and edges are compared in integers with one rule for ties, so that every
/// line crosses a closed surface as often inwards as outwards.
class SnappedTriangle {
 public:
  SnappedTriangle(const CellSurface& surface, int row, int axis) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int point = surface.triangles(row, k);
      const auto snapped = [&](int across) {
        return std::llround(surface.points(point, (axis + across) % 3) * double(kSnap));
      };
      corners_[k] = {snapped(1), snapped(2)};
      depths_[k] = surface.points(point, axis);
    }
    area_ = side_of(corners_[0], corners_[1], corners_[2]);
    if (area_ >= 0) return;
    std::swap(corners_[1], corners_[2]);
    std::swap(depths_[1], depths_[2]);
  }

  /// True if parallel to the lines: none crosses it.
  [[nodiscard]] bool is_empty() const { return area_ == 0; }
  /// +1 where lines enter, -1 where they leave: an outward triangle seen counter-clockwise along the axis faces
  /// forward.
  [[nodiscard]] int turn() const { return area_ > 0 ? -1 : 1; }
  [[nodiscard]] SnappedPoint low() const {
    return {std::min({corners_[0].u, corners_[1].u, corners_[2].u}),
            std::min({corners_[0].v, corners_[1].v, corners_[2].v})};
  }
  [[nodiscard]] SnappedPoint high() const {
    return {std::max({corners_[0].u, corners_[1].u, corners_[2].u}),
            std::max({corners_[0].v, corners_[1].v, corners_[2].v})};
  }

  /// Where the line at `place` crosses it, in cells; nothing if it misses.
  [[nodiscard]] std::optional<double> depth_at(const SnappedPoint& place) const {
    double weighted = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const SnappedPoint& a = corners_[(k + 1) % 3];
      const SnappedPoint& b = corners_[(k + 2) % 3];
      const std::int64_t side = side_of(a, b, place);
      if (side < 0 || (side == 0 && !owns_edge(a, b))) return std::nullopt;
      weighted += double(side) * depths_[k];
      sum += double(side);
    }
    return weighted / sum;
  }

 private:
  /// Twice the signed area of a, b, p: positive where p is left of the line from a to b.
  static std::int64_t side_of(const SnappedPoint& a, const SnappedPoint& b, const SnappedPoint& p) {
    return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
  }
  /// Of the two triangles at an edge, which traverse it in opposite directions, exactly one owns the points on it.
  static bool owns_edge(const SnappedPoint& a, const SnappedPoint& b) { return b.v < a.v || (b.v == a.v && b.u < a.u); }

  std::array<SnappedPoint, 3> corners_;
  std::array<double, 3> depths_;
  std::int64_t area_ = 0;
};

}  // namespace sprung
