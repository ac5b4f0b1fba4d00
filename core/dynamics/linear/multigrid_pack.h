// Compiled once for each instruction set: SPRUNG_INSTRUCTION_SET names the current one and the namespace of everything
// compiled for it, so that the linker cannot pick a function compiled for another.
#pragma once
#include <cstddef>
#include <experimental/simd>

#include "core/dynamics/linear/multigrid_kernels.h"

#ifndef SPRUNG_INSTRUCTION_SET
#define SPRUNG_INSTRUCTION_SET plain
#endif

namespace sprung::multigrid::SPRUNG_INSTRUCTION_SET {

/// N bricks side by side. A type of its own for the same reason: what brick_kernel.h instantiates for it is unique.
template <class Number, int N>
struct Pack {
  using Lanes = std::experimental::fixed_size_simd<Number, N>;
  Lanes lanes;

  Pack() = default;
  Pack(double value) : lanes(static_cast<Number>(value)) {}
  Pack(const Lanes& values) : lanes(values) {}

  friend Pack operator+(const Pack& a, const Pack& b) { return a.lanes + b.lanes; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.lanes - b.lanes; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.lanes * b.lanes; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.lanes / b.lanes; }
  friend Pack& operator+=(Pack& a, const Pack& b) { return a = a + b; }
  friend Pack& operator-=(Pack& a, const Pack& b) { return a = a - b; }
  friend Pack sqrt(const Pack& a) { return std::experimental::sqrt(a.lanes); }
};

using Doubles = Pack<double, kBricksPerBlock>;
using Floats = Pack<float, kLanes>;

template <class P, class Number>
P load(const Number* values) {
  typename P::Lanes lanes;
  lanes.copy_from(values, std::experimental::element_aligned);
  return lanes;
}

template <class P, class Number>
void store(const P& pack, Number* values) {
  pack.lanes.copy_to(values, std::experimental::element_aligned);
}

}  // namespace sprung::multigrid::SPRUNG_INSTRUCTION_SET
