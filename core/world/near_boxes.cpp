#include "core/world/near_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sprung {
namespace {

constexpr double kMostCells = 2e6;  // along an axis, so that a cell's number fits

struct Entry {
  std::int64_t cell;
  int box;
};

/// Cells of the middles of boxes, numbered along x first; a free one lies beyond each row and each layer.
class Cells {
 public:
  explicit Cells(const std::vector<AlignedBox>& boxes) {
    AlignedBox all;
    Vec3 largest = Vec3::Zero();
    for (const AlignedBox& box : boxes) {
      if (!is_finite(box)) continue;
      all.extend(box.center());
      largest = largest.cwiseMax(box.sizes());
    }
    if (all.isEmpty()) return;
    low_ = all.min();
    side_ = std::max({largest.maxCoeff(), all.sizes().maxCoeff() / kMostCells, 1e-300});
    const Eigen::Array3d counts = (all.sizes() / side_).array().floor() + 3;
    row_ = static_cast<std::int64_t>(counts.x());
    layer_ = row_ * static_cast<std::int64_t>(counts.y());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!is_finite(boxes[i])) continue;
      const Eigen::Array3d place = ((boxes[i].center() - low_) / side_).array().floor();
      entries_.push_back({static_cast<std::int64_t>(place.x()) + row_ * static_cast<std::int64_t>(place.y()) +
                              layer_ * static_cast<std::int64_t>(place.z()),
                          static_cast<int>(i)});
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.cell != b.cell ? a.cell < b.cell : a.box < b.box; });
  }

  /// Each pair of boxes in one or two touching cells, once.
  template <class Visit>
  void each_pair(const Visit& visit) const {
    // The cell itself and the one after it; then three rows ahead, each three cells long. Their starts only go up.
    const std::array<std::int64_t, 4> rows{row_ - 1, layer_ - row_ - 1, layer_ - 1, layer_ + row_ - 1};
    std::array<std::size_t, 4> starts{};
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const std::int64_t cell = entries_[i].cell;
      for (std::size_t j = i + 1; j < entries_.size() && entries_[j].cell <= cell + 1; ++j) {
        visit(entries_[i].box, entries_[j].box);
      }
      for (std::size_t row = 0; row < rows.size(); ++row) {
        std::size_t& start = starts[row];
        while (start < entries_.size() && entries_[start].cell < cell + rows[row]) ++start;
        for (std::size_t j = start; j < entries_.size() && entries_[j].cell <= cell + rows[row] + 2; ++j) {
          visit(entries_[i].box, entries_[j].box);
        }
      }
    }
  }

 private:
  static bool is_finite(const AlignedBox& box) { return box.min().allFinite() && box.max().allFinite(); }

  Vec3 low_ = Vec3::Zero();
  double side_ = 1;
  std::int64_t row_ = 3;
  std::int64_t layer_ = 9;
  std::vector<Entry> entries_;
};

}  // namespace

AlignedBox box_around(const Points& points) {
  if (points.rows() == 0) return {};
  return {Vec3(points.colwise().minCoeff()), Vec3(points.colwise().maxCoeff())};
}

AlignedBox widened(const AlignedBox& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

std::vector<std::pair<int, int>> overlapping_boxes(const std::vector<AlignedBox>& boxes,
                                                   const std::function<bool(int, int)>& is_kept) {
  std::vector<std::pair<int, int>> pairs;
  Cells(boxes).each_pair([&](int a, int b) {
    if (!boxes[static_cast<std::size_t>(a)].intersects(boxes[static_cast<std::size_t>(b)])) return;
    const std::pair<int, int> pair = std::minmax(a, b);
    if (is_kept(pair.first, pair.second)) pairs.push_back(pair);
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace sprung
