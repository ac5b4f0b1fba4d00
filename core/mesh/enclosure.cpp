#include "core/mesh/enclosure.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/winding_tree.h"

namespace sprung {

double enclosure(const Points& points, const Triangles& triangles, const std::vector<int>& rows) {
  constexpr std::size_t kSamples = 1000;
  const WindingTree tree(points, triangles, rows);
  std::vector<double> windings;
  for (std::size_t i = 0; i < rows.size(); i += 1 + rows.size() / kSamples) {
    const Vec3 middle = points(triangles.row(rows[i]), Eigen::all).colwise().mean();
    windings.push_back(tree.at(middle));
  }
  const auto median = windings.begin() + static_cast<std::ptrdiff_t>(windings.size() / 2);
  std::nth_element(windings.begin(), median, windings.end());
  return std::abs(*median);
}

}  // namespace sprung
