#include "core/body/brick_layers.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace sprung {
namespace {

/// Numbers the places of a lattice whose nodes are in its order.
std::vector<int> places_of(const std::vector<Eigen::Vector3i>& lattice) {
  std::vector<int> places(lattice.size(), 0);
  for (std::size_t i = 1; i < lattice.size(); ++i) {
    places[i] = places[i - 1] + (lattice[i] == lattice[i - 1] ? 0 : 1);
  }
  return places;
}

/// What holds a place of the lattice in each layer.
class Holders {
 public:
  explicit Holders(const std::vector<Eigen::Vector3i>& lattice) : places_(places_of(lattice)) {}

  /// The first layer in which these nodes meet none but themselves.
  [[nodiscard]] std::size_t layer_for(const std::array<int, 8>& nodes) const {
    std::size_t layer = 0;
    while (layer < holders_.size() && !is_free(holders_[layer], nodes)) ++layer;
    return layer;
  }
  void put(std::size_t layer, const std::array<int, 8>& nodes) {
    if (layer == holders_.size()) holders_.emplace_back();
    for (const int node : nodes) holders_[layer].emplace(place_of(node), node);
  }

 private:
  [[nodiscard]] int place_of(int node) const { return places_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] bool is_free(const std::unordered_map<int, int>& holders, const std::array<int, 8>& nodes) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
      const auto found = holders.find(place_of(node));
      return found == holders.end() || found->second == node;
    });
  }

  std::vector<int> places_;
  std::vector<std::unordered_map<int, int>> holders_;
};

bool has_no_doubles(const std::vector<Eigen::Vector3i>& ordered) {
  return std::adjacent_find(ordered.begin(), ordered.end()) == ordered.end();
}

}  // namespace

std::vector<std::vector<int>> layers_of(const BrickGrid& grid) {
  if (has_no_doubles(grid.lattice)) {
    std::vector<int> all(grid.cells.size());
    std::iota(all.begin(), all.end(), 0);
    return {std::move(all)};
  }
  Holders holders(grid.lattice);
  std::vector<std::vector<int>> layers;
  for (std::size_t brick = 0; brick < grid.cells.size(); ++brick) {
    const std::size_t layer = holders.layer_for(grid.nodes[brick]);
    holders.put(layer, grid.nodes[brick]);
    if (layer == layers.size()) layers.emplace_back();
    layers[layer].push_back(static_cast<int>(brick));
  }
  return layers;
}

}  // namespace sprung
