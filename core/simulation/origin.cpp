#include "core/simulation/origin.h"

#include <algorithm>

namespace sprung {

std::vector<int> Origin::pinned_nodes() const {
  std::vector<int> nodes;
  for (const PinnedNodes& pinned : pins) nodes.insert(nodes.end(), pinned.nodes.begin(), pinned.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<std::vector<int>> regions_of(const std::vector<Origin>& origins) {
  std::vector<std::vector<int>> regions;
  regions.reserve(origins.size());
  for (const Origin& origin : origins) regions.push_back(origin.regions);
  return regions;
}

}  // namespace sprung
