#include "app/film/springs.h"

#include <algorithm>
#include <cmath>

#include "core/bricks/brick_topology.h"

namespace sprung {

Eigen::VectorXd SpringSet::stretches(const Points& positions) const {
  Eigen::VectorXd values(rest.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto& [a, b] = nodes[i];
    values[i] = (positions.row(b) - positions.row(a)).norm() / rest[i] - 1;
  }
  return values;
}

SpringSet springs_of(const Body& body, const std::vector<bool>& shown) {
  SpringSet springs;
  const auto add = [&](const std::array<int, 8>& brick, const auto& pairs) {
    for (const auto& [from, to] : pairs) {
      const int a = brick[from];
      const int b = brick[to];
      springs.nodes.push_back({std::min(a, b), std::max(a, b)});
    }
  };
  for (std::size_t brick = 0; brick < body.grid.nodes.size(); ++brick) {
    if (!shown[brick]) continue;
    add(body.grid.nodes[brick], kEdges);
    if (body.law.face != 0) add(body.grid.nodes[brick], kFaceDiagonals);
    if (body.law.inner != 0) add(body.grid.nodes[brick], kInnerDiagonals);
  }
  std::sort(springs.nodes.begin(), springs.nodes.end());
  springs.nodes.erase(std::unique(springs.nodes.begin(), springs.nodes.end()), springs.nodes.end());
  springs.rest.resize(springs.nodes.size());
  for (Eigen::Index i = 0; i < springs.rest.size(); ++i) {
    const auto& [a, b] = springs.nodes[i];
    springs.rest[i] = (body.rest_positions.row(b) - body.rest_positions.row(a)).norm();
  }
  return springs;
}

}  // namespace sprung
