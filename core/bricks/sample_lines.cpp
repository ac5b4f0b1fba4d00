#include "core/bricks/sample_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace sprung {
namespace {

constexpr std::int64_t kSnap = 4096;  // whole numbers a cell, across the lines
constexpr std::int64_t kPitch = kSnap / kSamplesAlong;

struct Place {
  std::int64_t u;
  std::int64_t v;
};

/// Twice the signed area of a, b, p: positive where p is left of the line from a to b.
std::int64_t side_of(Place a, Place b, Place p) { return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u); }

/// Of the two triangles that share an edge, which run along it in opposite directions, just one owns the points on it.
bool owns_edge(Place a, Place b) { return b.v < a.v || (b.v == a.v && b.u < a.u); }

struct Crossing {
  std::int64_t line;
  double depth;  // cells
  int turn;      // +1 entering, -1 leaving
};

/// The lines between two places (both at least 0): first and last.
std::pair<std::int64_t, std::int64_t> lines_between(std::int64_t low, std::int64_t high) {
  return {(low + kPitch / 2 - 1) / kPitch, (high + kPitch / 2) / kPitch - 1};
}

class LineCaster {
 public:
  LineCaster(const CellSurface& surface, int axis)
      : surface_(surface),
        axis_(axis),
        axis_u_((axis + 1) % 3),
        axis_v_((axis + 2) % 3),
        along_u_(std::int64_t{surface.counts[axis_u_]} * kSamplesAlong) {}

  std::vector<InsideRun> runs() {
    for (int t = 0; t < surface_.triangles.rows(); ++t) cross_triangle(t);
    sort_crossings();
    std::vector<InsideRun> runs;
    runs.reserve(crossings_.size() / 2);
    for (std::size_t begin = 0; begin < crossings_.size();) begin = add_line(begin, runs);
    return runs;
  }

 private:
  [[nodiscard]] Place snapped(int point) const {
    return {std::llround(surface_.points(point, axis_u_) * static_cast<double>(kSnap)),
            std::llround(surface_.points(point, axis_v_) * static_cast<double>(kSnap))};
  }

  void cross_triangle(int t) {
    std::array<int, 3> corners{surface_.triangles(t, 0), surface_.triangles(t, 1), surface_.triangles(t, 2)};
    std::array<Place, 3> p{snapped(corners[0]), snapped(corners[1]), snapped(corners[2])};
    const std::int64_t area = side_of(p[0], p[1], p[2]);
    if (area == 0) return;
    const int turn = area > 0 ? -1 : 1;  // outward triangles: see cast_columns()
    if (area < 0) {
      std::swap(p[1], p[2]);
      std::swap(corners[1], corners[2]);
    }
    const auto [low_u, high_u] = std::minmax({p[0].u, p[1].u, p[2].u});
    const auto [low_v, high_v] = std::minmax({p[0].v, p[1].v, p[2].v});
    const auto [first_u, last_u] = lines_between(low_u, high_u);
    const auto [first_v, last_v] = lines_between(low_v, high_v);
    for (std::int64_t v = first_v; v <= last_v; ++v) {
      for (std::int64_t u = first_u; u <= last_u; ++u) cross_line(p, corners, turn, u, v);
    }
  }

  void cross_line(const std::array<Place, 3>& p, const std::array<int, 3>& corners, int turn, std::int64_t u,
                  std::int64_t v) {
    const Place line{u * kPitch + kPitch / 2, v * kPitch + kPitch / 2};
    double weighted = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Place& a = p[(k + 1) % 3];
      const Place& b = p[(k + 2) % 3];
      const std::int64_t side = side_of(a, b, line);
      if (side < 0 || (side == 0 && !owns_edge(a, b))) return;
      weighted += static_cast<double>(side) * surface_.points(corners[k], axis_);
      sum += static_cast<double>(side);
    }
    crossings_.push_back({v * along_u_ + u, weighted / sum, turn});
  }

  void sort_crossings() {
    std::stable_sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
      return a.line != b.line ? a.line < b.line : a.depth < b.depth;
    });
  }

  /// Returns where the next line begins.
  std::size_t add_line(std::size_t begin, std::vector<InsideRun>& runs) const {
    const std::int64_t line = crossings_[begin].line;
    const std::size_t runs_before = runs.size();
    int winding = 0;
    std::size_t i = begin;
    double entered = 0;
    for (; i < crossings_.size() && crossings_[i].line == line; ++i) {
      const int before = winding;
      winding += crossings_[i].turn;
      if (before == 0) entered = crossings_[i].depth;
      if (winding != 0 || crossings_[i].depth <= entered) continue;
      runs.push_back(
          {static_cast<int>(line % along_u_), static_cast<int>(line / along_u_), entered, crossings_[i].depth});
    }
    if (winding != 0) runs.resize(runs_before);
    return i;
  }

  const CellSurface& surface_;
  int axis_;
  int axis_u_;
  int axis_v_;
  std::int64_t along_u_;
  std::vector<Crossing> crossings_;
};

}  // namespace

std::vector<InsideRun> inside_runs(const CellSurface& surface, int axis) { return LineCaster(surface, axis).runs(); }

}  // namespace sprung
