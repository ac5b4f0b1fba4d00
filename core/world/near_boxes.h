#pragma once
#include <functional>
#include <utility>
#include <vector>

#include "core/types.h"

namespace sprung {

using AlignedBox = Eigen::AlignedBox3d;

/// Of points; empty where there are none.
[[nodiscard]] AlignedBox box_around(const Points& points);

/// Larger by so much on every side.
[[nodiscard]] AlignedBox widened(const AlignedBox& box, double by);

/// Rows i < j of boxes that overlap and that `is_kept`, in a fixed order. A grid with cells as large as the largest
/// box: quick where boxes are of about one size. Throws nothing; boxes that are not finite overlap nothing.
[[nodiscard]] std::vector<std::pair<int, int>> overlapping_boxes(
    const std::vector<AlignedBox>& boxes, const std::function<bool(int, int)>& is_kept = [](int, int) { return true; });

}  // namespace sprung
