#pragma once
#include <cstddef>

namespace sprung {

/// A brick's matrix without its first corner: the forces that hold a translation are zero, so corners 1 .. 7 say all.
/// Lower triangle, entries (a, b), b <= a, with a, b from 0 to 20; the three rows of a corner column by column, in the
/// order in which products read them, then the triangle of its own block.
inline constexpr std::size_t kAnchoredSize = 21 * 22 / 2;
[[nodiscard]] constexpr std::size_t anchored_index(std::size_t a, std::size_t b) {
  const std::size_t row = a % 3;
  const std::size_t own = a - row;  // first column of its own block
  const std::size_t first = own * (own + 1) / 2;
  return first + (b < own ? 3 * b + row : 3 * own + row * (row + 1) / 2 + (b - own));
}

}  // namespace sprung
