#pragma once
#include <array>
#include <vector>

#include "core/body/body.h"

namespace sprung {

/// The springs of a body, each once: pairs of nodes and lengths at rest.
struct SpringSet {
  std::vector<std::array<int, 2>> nodes;
  Eigen::VectorXd rest;  // m

  /// Length over length at rest, less 1, for these positions of the nodes (m x 3, m).
  [[nodiscard]] Eigen::VectorXd stretches(const Points& positions) const;
};

/// Edges, and the diagonals that the body's law has, of the bricks that are `shown` (one a brick).
[[nodiscard]] SpringSet springs_of(const Body& body, const std::vector<bool>& shown);

}  // namespace sprung
