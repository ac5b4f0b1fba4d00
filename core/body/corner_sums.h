#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/corner_lists.h"

namespace sprung {

/// Sums at nodes of what is known at the corners of bricks, in the order of the bricks: the same bits for any number of
/// threads. For one body; kept from step to step.
class CornerSums {
 public:
  /// Room for x y z at each corner, 24 numbers a brick.
  [[nodiscard]] double* room(const BrickGrid& grid);

  /// x y z a node, to `sums`.
  void sum(double* sums) const;

 private:
  CornerLists lists_;
  std::vector<double> at_corners_;
};

}  // namespace sprung
