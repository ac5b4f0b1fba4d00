#pragma once
#include <array>

namespace sprung {

/// Corner c of a brick lies on the high side of axis i if bit i of c is set.
[[nodiscard]] constexpr bool on_high_side(int corner, int axis) { return ((corner >> axis) & 1) != 0; }

/// A spring of a brick: the corners it joins; `to` is on the high side of the spring's (first) axis.
struct CornerPair {
  int from;
  int to;
};

/// Edge 4 i + s runs along axis i; bit 0 of s is its side in j = (i + 1) % 3, bit 1 its side in k = (i + 2) % 3.
[[nodiscard]] constexpr CornerPair brick_edge(int axis, int side) {
  const int from = (side & 1) << ((axis + 1) % 3) | (side >> 1) << ((axis + 2) % 3);
  return {from, from | 1 << axis};
}

namespace detail {

constexpr std::array<CornerPair, 12> make_edges() {
  std::array<CornerPair, 12> edges{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) edges[4 * axis + side] = brick_edge(axis, side);
  }
  return edges;
}

constexpr std::array<CornerPair, 12> make_face_diagonals() {
  std::array<CornerPair, 12> diagonals{};
  std::size_t count = 0;
  for (int normal = 0; normal < 3; ++normal) {
    const int j = 1 << ((normal + 1) % 3);
    const int k = 1 << ((normal + 2) % 3);
    for (int side = 0; side < 2; ++side) {
      const int base = side << normal;
      diagonals[count++] = {base, base | j | k};
      diagonals[count++] = {base | j, base | k};
    }
  }
  return diagonals;
}

}  // namespace detail

inline constexpr std::array<CornerPair, 12> kEdges = detail::make_edges();
inline constexpr std::array<CornerPair, 12> kFaceDiagonals = detail::make_face_diagonals();
inline constexpr std::array<CornerPair, 4> kInnerDiagonals{{{0, 7}, {1, 6}, {2, 5}, {3, 4}}};

/// A number for each edge's side: -1 on the low side, +1 on the high one. `which`: 0 for j, 1 for k.
[[nodiscard]] constexpr double edge_sign(int side, int which) { return ((side >> which) & 1) != 0 ? 1.0 : -1.0; }

}  // namespace sprung
