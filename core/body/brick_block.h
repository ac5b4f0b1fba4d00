#pragma once
#include <array>

#include "core/law/brick_law.h"

namespace sprung {

struct Body;

inline constexpr int kBricksPerBlock = 8;  // computed side by side

/// Input of loops over blocks of bricks, as plain arrays: no library whose code would depend on the instruction set.
struct BlockInput {
  const BrickLaw* law;
  double brick_size;  // m
  int brick_count;
  const std::array<int, 8>* nodes;  // per brick
  const double* stiffness_scale;    // per brick
  const double* positions;          // x y z per node, m
};

/// The arrays of a body, which must outlive it.
[[nodiscard]] BlockInput block_input(const Body& body);

}  // namespace sprung
