#pragma once
#include <algorithm>
#include <array>
#include <span>

#include "core/dynamics/linear/multigrid_pack.h"

namespace sprung::multigrid::SPRUNG_INSTRUCTION_SET {

using Matrix24 = std::array<std::array<Floats, 24>, 24>;
using Pull = std::array<std::array<Floats, 3>, 24>;

/// One octant's children of up to sixteen coarse bricks, one per lane.
struct Octant {
  std::array<int, kLanes> blocks;   // of the finer level, -1: no child
  std::array<int, kLanes> pulls;    // -1: none
  std::array<int, kLanes> lanes{};  // within the block
  bool any = false;
  bool any_pull = false;

  Octant(const FineMatrices& fine, std::span<const Children> bricks, std::size_t octant) {
    blocks.fill(-1);
    pulls.fill(-1);
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      const int child = bricks[i][octant];
      if (child < 0) continue;
      blocks[i] = child / kLanes;
      lanes[i] = child % kLanes;
      pulls[i] = fine.pull_of_block[blocks[i]];
      any = true;
      any_pull = any_pull || pulls[i] >= 0;
    }
  }

  /// One entry of `entries` of each child, 0 if there is none.
  [[nodiscard]] Floats pick(const std::array<int, kLanes>& from, const float* values, std::size_t entries,
                            std::size_t entry) const {
    alignas(64) std::array<float, kLanes> picked{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (from[i] < 0) continue;
      picked[i] = values[(std::size_t(from[i]) * entries + entry) * kLanes + lanes[i]];
    }
    return load<Floats>(picked.data());
  }
};

inline void pick_pulls(const FineMatrices& fine, const Octant& octant, Pull& pull) {
  for (std::size_t row = 0; row < 24; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      pull[row][k] = octant.any_pull ? octant.pick(octant.pulls, fine.pulls, kPullSize, 3 * row + k) : Floats(0.0);
    }
  }
}

/// Whole matrices: the anchored part, and the part of a row's pull that corners 1 .. 7 leave to corner 0.
inline void pick_matrices(const FineMatrices& fine, const Octant& octant, const Pull& pull, Matrix24& matrix) {
  for (std::size_t a = 0; a < 21; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const Floats entry = octant.pick(octant.blocks, fine.matrices, kAnchoredSize, anchored_index(a, b));
      matrix[a + 3][b + 3] = entry;
      matrix[b + 3][a + 3] = entry;
    }
  }
  const auto left_to_first = [&](std::size_t row, std::size_t k) {
    Floats rest = pull[row][k];
    for (std::size_t corner = 1; corner < 8; ++corner) rest -= matrix[row][3 * corner + k];
    return rest;
  };
  for (std::size_t row = 3; row < 24; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      matrix[row][k] = left_to_first(row, k);
      matrix[k][row] = matrix[row][k];
    }
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) matrix[row][k] = left_to_first(row, k);
  }
}

/// Maps rows of corners to rows of the coarse brick's corners, between which the child in that octant is interpolated.
template <std::size_t Columns>
void restrict_rows(std::array<std::array<Floats, Columns>, 24>& rows, std::size_t octant) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool high = (octant >> axis & 1U) != 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      if ((corner >> axis & 1U) != 0) continue;
      // The corner in the middle of the coarse edge is shared between its two ends.
      const std::size_t middle = high ? corner : corner | 1U << axis;
      const std::size_t end = high ? corner | 1U << axis : corner;
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t column = 0; column < Columns; ++column) {
          Floats& half = rows[3 * middle + k][column];
          half = 0.5 * half;
          rows[3 * end + k][column] += half;
        }
      }
    }
  }
}

inline void transpose(Matrix24& matrix) {
  for (std::size_t a = 0; a < 24; ++a) {
    for (std::size_t b = 0; b < a; ++b) std::swap(matrix[a][b], matrix[b][a]);
  }
}

[[gnu::flatten]] inline bool coarsen_block(const FineMatrices& fine, std::span<const Children> bricks, float* matrix,
                                           float* pull) {
  Matrix24 child;
  Pull child_pull;
  std::array<Floats, kAnchoredSize> sum;
  Pull pull_sum;
  sum.fill(Floats(0.0));
  for (auto& row : pull_sum) row.fill(Floats(0.0));
  bool has_pull = false;
  for (std::size_t octant = 0; octant < 8; ++octant) {
    const Octant children(fine, bricks, octant);
    if (!children.any) continue;
    has_pull = has_pull || children.any_pull;
    pick_pulls(fine, children, child_pull);
    pick_matrices(fine, children, child_pull, child);
    restrict_rows(child, octant);
    transpose(child);
    restrict_rows(child, octant);
    for (std::size_t a = 0; a < 21; ++a) {
      for (std::size_t b = 0; b <= a; ++b) sum[anchored_index(a, b)] += child[a + 3][b + 3];
    }
    restrict_rows(child_pull, octant);
    for (std::size_t row = 0; row < 24; ++row) {
      for (std::size_t k = 0; k < 3; ++k) pull_sum[row][k] += child_pull[row][k];
    }
  }
  for (std::size_t i = 0; i < kAnchoredSize; ++i) store(sum[i], matrix + i * kLanes);
  for (std::size_t row = 0; row < 24; ++row) {
    for (std::size_t k = 0; k < 3; ++k) store(pull_sum[row][k], pull + (3 * row + k) * kLanes);
  }
  return has_pull;
}

}  // namespace sprung::multigrid::SPRUNG_INSTRUCTION_SET
