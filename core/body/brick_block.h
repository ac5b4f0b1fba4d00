#pragma once
#include <array>

#include "core/law/brick_law.h"

namespace sprung {

inline constexpr int kBricksPerBlock = 8;  // computed side by side

/// What the innermost loop reads, as plain arrays: no library whose code would depend on the instruction set.
struct BlockInput {
  const BrickLaw* law;
  double brick_size;  // m
  int brick_count;
  const std::array<int, 8>* nodes;  // a brick
  const double* stiffness_scale;    // a brick
  const double* positions;          // x y z a node, m
  const double* velocities;         // x y z a node, m/s
  double beta;                      // s
};

/// Forces (24 a brick, N, corner by corner) and energies (J) of the block of bricks that starts at brick `first`,
/// their share of a full brick and beta damping included. The last block may be short.
using BlockForces = void (*)(const BlockInput& input, int first, double* corner_forces, double* energies);

/// The version for the widest vectors this processor has. All versions give the same bits.
[[nodiscard]] BlockForces block_forces();

/// Each version by itself, for tests; null where the processor cannot run it.
struct NamedBlockForces {
  const char* name;
  BlockForces forces;
};
[[nodiscard]] std::array<NamedBlockForces, 3> all_block_forces();

}  // namespace sprung
