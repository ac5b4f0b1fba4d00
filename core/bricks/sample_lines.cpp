#include "core/bricks/sample_lines.h"

#include <algorithm>
#include <cstdint>

#include "core/bricks/snapped_triangle.h"

namespace sprung {
namespace {

constexpr std::int64_t kPitch = kSnap / kSamplesAlong;

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
      : surface_(surface), axis_(axis), along_u_(std::int64_t{surface.counts[(axis + 1) % 3]} * kSamplesAlong) {}

  std::vector<InsideRun> runs() {
    for (int t = 0; t < surface_.triangles.rows(); ++t) cross_triangle(t);
    sort_crossings();
    std::vector<InsideRun> runs;
    runs.reserve(crossings_.size() / 2);
    for (std::size_t begin = 0; begin < crossings_.size();) begin = add_line(begin, runs);
    return runs;
  }

 private:
  void cross_triangle(int t) {
    const SnappedTriangle triangle(surface_, t, axis_);
    if (triangle.is_empty()) return;
    const auto [low_u, low_v] = triangle.low();
    const auto [high_u, high_v] = triangle.high();
    const auto [first_u, last_u] = lines_between(low_u, high_u);
    const auto [first_v, last_v] = lines_between(low_v, high_v);
    for (std::int64_t v = first_v; v <= last_v; ++v) {
      for (std::int64_t u = first_u; u <= last_u; ++u) {
        const std::optional<double> depth = triangle.depth_at({u * kPitch + kPitch / 2, v * kPitch + kPitch / 2});
        if (depth) crossings_.push_back({v * along_u_ + u, *depth, triangle.turn()});
      }
    }
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
  std::int64_t along_u_;
  std::vector<Crossing> crossings_;
};

}  // namespace

std::vector<InsideRun> inside_runs(const CellSurface& surface, int axis) { return LineCaster(surface, axis).runs(); }

}  // namespace sprung
