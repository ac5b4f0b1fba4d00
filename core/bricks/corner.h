#pragma once

namespace sprung {

/// Corner c of a brick lies on the high side of axis i where bit i of c is set.
[[nodiscard]] constexpr bool on_high_side(int corner, int axis) { return ((corner >> axis) & 1) != 0; }

}  // namespace sprung
