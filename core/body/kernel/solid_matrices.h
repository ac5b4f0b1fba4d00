#pragma once
#include "core/body/kernel/solid_rows.h"
#include "core/law/anchored_matrix.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

/// Visits the corners, or the vectors of the map, pair by pair along each axis: does for matrices what trilinear_map()
/// and give_corners() do row by row.
template <class Join>
[[gnu::always_inline]] inline void join_pairs(TrilinearMap& values, const Join& join) {
#pragma GCC unroll 3
  for (std::size_t bit = 1; bit < 8; bit *= 2) {
#pragma GCC unroll 8
    for (std::size_t low = 0; low < 8; ++low) {
      if ((low & bit) == 0) join(values[low], values[low | bit]);
    }
  }
}

/// The sum and the difference of each pair.
[[nodiscard]] [[gnu::always_inline]] inline TrilinearMap map_of_corners(TrilinearMap values) {
  join_pairs(
      values, [](Pack3 & low, Pack3 & high) __attribute__((always_inline)) {
        const Pack3 sum = high + low;
        high = high - low;
        low = sum;
      });
  return values;
}

/// Its transpose.
[[nodiscard]] [[gnu::always_inline]] inline TrilinearMap corners_of_map(TrilinearMap values) {
  join_pairs(
      values, [](Pack3 & low, Pack3 & high) __attribute__((always_inline)) {
        const Pack3 sum = high + low;
        low = low - high;
        high = sum;
      });
  return values;
}

/// The map of bricks with one corner displaced by one along an axis and all others fixed.
[[nodiscard]] inline TrilinearMap move_of(std::size_t corner, std::size_t axis) {
  TrilinearMap corners;
  corners.fill({Pack(0.0), Pack(0.0), Pack(0.0)});
  (axis == 0 ? corners[corner].x : axis == 1 ? corners[corner].y : corners[corner].z) = Pack(1.0);
  return map_of_corners(corners);
}

/// See SolidMatrices; for the bricks in the lanes from `own`, `corners` and `matrices` on.
template <bool kCut>
void write_matrices(const SolidLaw& law, const double* own, const double* corners, double* matrices) {
  const auto corner = [&](std::size_t index) {
    const double* values = corners + 3 * index * kPackPadding;
    return Pack3{load(values), load(values + kPackPadding), load(values + 2 * kPackPadding)};
  };
  TrilinearMap map;
  for (std::size_t i = 0; i < 8; ++i) map[i] = corner(i);
  const PackOfSolids<Part::kProduct, kCut> bricks(law, own);
  const auto state = bricks.state(map_of_corners(map));
  for (std::size_t column = 0; column < 21; ++column) {
    const TrilinearMap forces = corners_of_map(bricks.product(state, move_of(1 + column / 3, column % 3)));
    for (std::size_t row = column; row < 21; ++row) {
      const Pack3& force = forces[1 + row / 3];
      store(row % 3 == 0   ? force.x
            : row % 3 == 1 ? force.y
                           : force.z,
            matrices + anchored_index(row, column) * kPackPadding);
    }
  }
}

inline void solid_matrices(const SolidLaw& law, const double* own, const double* corners, double* matrices) {
  for (int i = 0; i < kPackPadding; i += kLanes) {
    if (*own < 0) {
      write_matrices<true>(law, own + i, corners + i, matrices + i);
    } else {
      write_matrices<false>(law, own + i, corners + i, matrices + i);
    }
  }
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
