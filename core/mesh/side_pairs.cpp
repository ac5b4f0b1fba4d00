#include "core/mesh/side_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

namespace sprung {

std::vector<Side> sorted_sides(const Triangles& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k);
      const int b = triangles(t, (k + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

SidePairs::SidePairs(const Points& points, const Triangles& triangles, const std::vector<int>& pieces)
    : points_(points), triangles_(triangles), pieces_(pieces), sets_(static_cast<std::size_t>(triangles.rows())) {}

void SidePairs::pair(std::span<const Side> edge) {
  if (edge.size() == 2 && edge[0].forward != edge[1].forward) {
    sets_.merge(edge[0].triangle, edge[1].triangle);
  } else if (edge.size() <= 2) {
    open_.insert(open_.end(), edge.begin(), edge.end());
  } else {
    pair_many(edge);
  }
}

void SidePairs::pair_many(std::span<const Side> edge) {
  std::vector<Side> around(edge.begin(), edge.end());
  sort_around(around);
  std::set<int> pieces;
  for (const Side& side : around) pieces.insert(piece_of(side));
  std::vector<Side> left;
  for (const int piece : pieces) {
    std::vector<Side> own;
    std::copy_if(around.begin(), around.end(), std::back_inserter(own),
                 [&](const Side& side) { return piece_of(side) == piece; });
    pair_around(own);
    left.insert(left.end(), own.begin(), own.end());
  }
  sort_around(left);
  pair_around(left);
  open_.insert(open_.end(), left.begin(), left.end());
}

/// Seen along the edge, matter begins at a side that runs backward and ends at the next one that runs forward.
void SidePairs::pair_around(std::vector<Side>& sides) {
  for (std::size_t i = 0; i < sides.size() && sides.size() > 1;) {
    const std::size_t next = (i + 1) % sides.size();
    if (sides[i].forward || !sides[next].forward) {
      ++i;
      continue;
    }
    sets_.merge(sides[i].triangle, sides[next].triangle);
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
    i = 0;
  }
}

/// By the angle of their triangles about the edge.
void SidePairs::sort_around(std::vector<Side>& edge) const {
  if (edge.empty()) return;
  const Vec3 low = points_.row(edge[0].low);
  const Vec3 axis = (points_.row(edge[0].high).transpose() - low).normalized();
  const Vec3 across = axis.unitOrthogonal();
  std::vector<std::pair<double, Side>> angles;
  for (const Side& side : edge) {
    const int apex = triangles_.row(side.triangle).sum() - side.low - side.high;
    const Vec3 out = points_.row(apex).transpose() - low;
    angles.emplace_back(std::atan2(out.dot(axis.cross(across)), out.dot(across)), side);
  }
  std::stable_sort(angles.begin(), angles.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < edge.size(); ++i) edge[i] = angles[i].second;
}

}  // namespace sprung
