#include "core/world/world.h"

#include <algorithm>

namespace sprung {

std::vector<int> Origin::pinned_nodes() const {
  std::vector<int> nodes;
  for (const PinnedNodes& pinned : pins) nodes.insert(nodes.end(), pinned.nodes.begin(), pinned.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Points SoftBody::skin_positions(const Points& nodes) const { return deform_points(grid, skin_embedding, nodes); }

}  // namespace sprung
