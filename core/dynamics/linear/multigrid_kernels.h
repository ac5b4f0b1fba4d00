#pragma once
#include <array>
#include <span>

#include "core/body/brick_block.h"
#include "core/body/brick_stiffness.h"

namespace sprung::multigrid {

inline constexpr int kLanes = 16;                 // bricks side by side in single precision
inline constexpr std::size_t kPullSize = 24 * 3;  // of a brick's pull: see LevelBlock
using BrickNodes = std::array<int, 8>;

/// Sixteen bricks of one level, each a symmetric 24 x 24 matrix C kept as its anchored part (corners 1 .. 7), which
/// resists no translation, and its pull C T (24 x 3, T the three translations), which is zero unless something outside
/// the brick holds it. In single precision, a free brick's matrix still leaves translations entirely free.
struct LevelBlock {
  const float* matrix;  // kAnchoredSize x 16
  const float* pull;    // kPullSize x 16, or null: all zero
  const BrickNodes* nodes;
  int count;  // bricks, at most 16; lanes beyond have zero matrices
};

/// One coarse brick's children, by octant (bit i: on the high side of axis i); -1: none.
using Children = std::array<int, 8>;

/// The bricks of the finer level, whole blocks.
struct FineMatrices {
  const float* matrices;     // kAnchoredSize x 16 per block
  const float* pulls;        // kPullSize x 16 per block that has one
  const int* pull_of_block;  // which; -1: none
};

/// The innermost loops, once for each instruction set. All versions give the same bits.
struct Kernels {
  /// 24 products K u (N) per brick, corner by corner, `moves` x y z per node (u, m), for the kBricksPerBlock bricks
  /// from `first` on.
  void (*stiffness_product)(const BlockInput& block, const double* moves, int first, double* corner_products);

  /// Anchored matrices (kAnchoredSize x 16) of the bricks from `first` on, the springs' axial stiffness times
  /// `material`; zero in lanes beyond the last brick.
  void (*stiffness_matrices)(const BlockInput& input, const EdgeCoupling& coupling, double material, int first,
                             float* matrix);

  /// The forces C x of each brick at its corners, 24 x 16.
  void (*apply)(const LevelBlock& block, const float* x, float* corner_forces);
  void (*apply_double)(const LevelBlock& block, const double* x, double* corner_forces);

  /// The 3 x 3 blocks on the diagonal of C: xx, xy, xz, yy, yz, zz corner by corner, 48 x 16.
  void (*corner_blocks)(const LevelBlock& block, float* blocks);

  /// Galerkin's coarse bricks, P^T C P summed over the children, P trilinear. `pull` (kPullSize x 16) is set where any
  /// child has one; true then.
  bool (*coarsen)(const FineMatrices& fine, std::span<const Children> bricks, float* matrix, float* pull);
};

/// The versions that this processor can run, the widest first.
[[nodiscard]] std::span<const Kernels> all_kernels();
[[nodiscard]] inline const Kernels& kernels() { return all_kernels().front(); }

}  // namespace sprung::multigrid
