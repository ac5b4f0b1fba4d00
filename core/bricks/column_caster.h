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

/// A closed surface in units of cells: the box of `counts` cells that holds it begins at 0.
struct CellSurface {
  Points points;  // p x 3, in [0, counts]
  const Triangles& triangles;
  Eigen::Vector3i counts;
};

/// The most cells along one axis that the exact arithmetic of the caster can tell apart.
inline constexpr int kMostCellsPerAxis = 1 << 16;

/// What rays along the axes say of each cell of the box; x fastest, then y, then z.
struct CellSums {
  std::vector<float> weighted;  // sum over the axes of weight x share of the cell inside
  std::vector<float> weight;    // sum over the axes: the more a ray direction crosses the surface in a cell, the better
                                // it measures it; directions along a flat wall hardly count
};

/// Adds to `sums` what rays along `axis` say: 16 rays a cell, the length inside exact along each. Inside is where the
/// surface winds around a point at all. Rays and edges are compared in whole numbers, with one rule for ties, so every
/// ray enters as often as it leaves, and a ray along a face or through an edge does no harm.
void cast_columns(const CellSurface& surface, int axis, CellSums& sums);

inline constexpr std::int64_t kSnap = 4096;  // whole numbers a cell, across the lines

/// A place across lines along an axis: u along the next axis, v along the one after it, in whole numbers.
struct SnappedPlace {
  std::int64_t u;
  std::int64_t v;
};

/// A triangle as lines along an axis see it. Lines and edges are compared in whole numbers, with one rule for ties, so
/// that every line crosses a closed surface as often inwards as outwards.
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

  /// Seen from the side: no line crosses it.
  [[nodiscard]] bool is_empty() const { return area_ == 0; }
  /// +1 where lines enter, -1 where they leave: an outward triangle seen counter-clockwise along the axis faces
  /// forward.
  [[nodiscard]] int turn() const { return area_ > 0 ? -1 : 1; }
  [[nodiscard]] SnappedPlace low() const {
    return {std::min({corners_[0].u, corners_[1].u, corners_[2].u}),
            std::min({corners_[0].v, corners_[1].v, corners_[2].v})};
  }
  [[nodiscard]] SnappedPlace high() const {
    return {std::max({corners_[0].u, corners_[1].u, corners_[2].u}),
            std::max({corners_[0].v, corners_[1].v, corners_[2].v})};
  }

  /// Where the line at `place` crosses it, in cells; nothing where it passes by.
  [[nodiscard]] std::optional<double> depth_at(const SnappedPlace& place) const {
    double weighted = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const SnappedPlace& a = corners_[(k + 1) % 3];
      const SnappedPlace& b = corners_[(k + 2) % 3];
      const std::int64_t side = side_of(a, b, place);
      if (side < 0 || (side == 0 && !owns_edge(a, b))) return std::nullopt;
      weighted += double(side) * depths_[k];
      sum += double(side);
    }
    return weighted / sum;
  }

 private:
  /// Twice the signed area of a, b, p: positive where p is left of the line from a to b.
  static std::int64_t side_of(const SnappedPlace& a, const SnappedPlace& b, const SnappedPlace& p) {
    return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
  }
  /// Of the two triangles that share an edge, which run along it in opposite directions, just one owns the points on
  /// it.
  static bool owns_edge(const SnappedPlace& a, const SnappedPlace& b) { return b.v < a.v || (b.v == a.v && b.u < a.u); }

  std::array<SnappedPlace, 3> corners_;
  std::array<double, 3> depths_;
  std::int64_t area_ = 0;
};

}  // namespace sprung
