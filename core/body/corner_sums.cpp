#include "core/body/corner_sums.h"

#include <tbb/parallel_for.h>

#include "core/types.h"

namespace sprung {
namespace {

constexpr int kNodesPerTask = 512;

}  // namespace

double* CornerSums::room(const BrickGrid& grid) {
  if (lists_.first.empty()) {
    lists_ = list_corners(grid.nodes, grid.node_count());
    at_corners_.resize(3 * lists_.corners.size());
  }
  return at_corners_.data();
}

void CornerSums::sum(double* sums) const {
  const int nodes = static_cast<int>(lists_.first.size()) - 1;
  tbb::parallel_for(tbb::blocked_range<int>(0, nodes, kNodesPerTask), [&](const tbb::blocked_range<int>& range) {
    for (int node = range.begin(); node < range.end(); ++node) {
      Vec3 sum = Vec3::Zero();
      const auto n = static_cast<std::size_t>(node);
      for (int i = lists_.first[n]; i < lists_.first[n + 1]; ++i) {
        const auto corner = static_cast<std::size_t>(lists_.corners[static_cast<std::size_t>(i)]);
        sum += Eigen::Map<const Vec3>(&at_corners_[3 * corner]);
      }
      Eigen::Map<Vec3>(sums + 3 * static_cast<std::ptrdiff_t>(node)) = sum;
    }
  });
}

}  // namespace sprung
