// Compiled once for each instruction set; SPRUNG_INSTRUCTION_SET names the current one.
#include "core/dynamics/linear/multigrid_kernels.h"

#include <algorithm>

#include "core/dynamics/linear/multigrid_galerkin.h"
#include "core/dynamics/linear/multigrid_pack.h"

namespace sprung::multigrid::SPRUNG_INSTRUCTION_SET {

[[nodiscard]] Kernels kernels();

namespace {

/// Bricks side by side; the last one is repeated if there are fewer. In single precision, positions are relative to the
/// first corner before they are rounded.
template <class P>
CornerVectors<P> gather(const BlockInput& input, const double* values, int first, int lanes) {
  using Number = typename P::Lanes::value_type;
  alignas(64) Number places[24][P::Lanes::size()];
  for (int lane = 0; lane < lanes; ++lane) {
    const BrickNodes& nodes = input.nodes[std::min(first + lane, input.brick_count - 1)];
    const double* origin = values + 3 * std::ptrdiff_t(nodes[0]);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const double* value = values + 3 * std::ptrdiff_t(nodes[corner]);
      for (std::size_t k = 0; k < 3; ++k) places[3 * corner + k][lane] = static_cast<Number>(value[k] - origin[k]);
    }
  }
  CornerVectors<P> packed;
  for (std::size_t i = 0; i < 24; ++i) packed[i].lanes.copy_from(places[i], std::experimental::element_aligned);
  return packed;
}

[[gnu::flatten]] void stiffness_product_block(const BlockInput& block, const double* moves, int first,
                                              double* corner_products) {
  const auto u = gather<Doubles>(block, moves, first, kBricksPerBlock);
  const auto x = gather<Doubles>(block, block.positions, first, kBricksPerBlock);
  CornerVectors<Doubles> product;
  product.fill(Doubles(0.0));
  stiffness_product<Doubles>(*block.law, block.brick_size, x, u, product);
  const int lanes = std::min(kBricksPerBlock, block.brick_count - first);
  for (int lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t brick = first + lane;
    for (std::size_t i = 0; i < 24; ++i) {
      corner_products[24 * brick + int(i)] = block.stiffness_scale[brick] * product[i].lanes[lane];
    }
  }
}

[[gnu::flatten]] void stiffness_matrices_block(const BlockInput& input, const EdgeCoupling& coupling, double material,
                                               int first, float* matrix) {
  const auto x = gather<Floats>(input, input.positions, first, kLanes);
  const double h = input.brick_size;
  Floats scale(0.0);
  for (int lane = 0; lane < std::min(kLanes, input.brick_count - first); ++lane) {
    scale.lanes[lane] = float(input.stiffness_scale[first + lane]);
  }
  std::array<Floats, kAnchoredSize> packed;
  anchored_stiffness<Floats>(*input.law, coupling, h, material, x, packed);
  for (std::size_t i = 0; i < kAnchoredSize; ++i) store(scale * packed[i], matrix + i * kLanes);
}

/// A pack of entries. Those of the next block are prefetched: memory limits products.
template <class P>
P entries_at(const float* entries) {
  __builtin_prefetch(entries + kAnchoredSize * kLanes);
  return load<P>(entries);
}

/// C v by the anchored part, and the reaction at corner 0. Three rows at a time: their sums are independent, and the
/// columns are loaded once for all three.
template <class P>
void multiply_anchored(const float* matrix, const std::array<P, 24>& v, std::array<P, 24>& y) {
  const auto entry = [&](std::size_t a, std::size_t b) {
    return entries_at<P>(matrix + anchored_index(a, b) * kLanes);
  };
  y.fill(P(0.0));
  for (std::size_t a = 0; a < 21; a += 3) {
    const std::array<P, 3> moves{v[a + 3], v[a + 4], v[a + 5]};
    std::array<P, 3> sums{P(0.0), P(0.0), P(0.0)};
    for (std::size_t b = 0; b < a; ++b) {
      const P& column = v[b + 3];
      const std::array<P, 3> entries{entry(a, b), entry(a + 1, b), entry(a + 2, b)};
      for (std::size_t k = 0; k < 3; ++k) sums[k] += entries[k] * column;
      y[b + 3] += entries[0] * moves[0] + entries[1] * moves[1] + entries[2] * moves[2];
    }
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        sums[r] += entry(a + std::max(r, c), a + std::min(r, c)) * moves[c];
      }
      y[a + 3 + r] += sums[r];
    }
  }
  for (std::size_t corner = 1; corner < 8; ++corner) {
    for (std::size_t k = 0; k < 3; ++k) y[k] -= y[3 * corner + k];
  }
}

template <class P>
void add_pull(const float* pull, const std::array<P, 3>& origin, const std::array<P, 24>& v, std::array<P, 24>& y) {
  for (std::size_t row = 0; row < 24; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      const P entry = load<P>(pull + (3 * row + k) * kLanes);
      y[row] += entry * origin[k];
      if (row >= 3) y[k] += entry * v[row];
    }
  }
}

template <class Number>
[[gnu::flatten]] void apply_block(const LevelBlock& block, const Number* x, Number* corner_forces) {
  using P = Pack<Number, kLanes>;
  std::array<P, 24> v;
  std::array<P, 3> origin;
  alignas(64) Number places[24][kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    const BrickNodes& nodes = block.nodes[std::min(lane, block.count - 1)];
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Number* value = x + 3 * std::ptrdiff_t(nodes[corner]);
      for (std::size_t k = 0; k < 3; ++k) places[3 * corner + k][lane] = value[k];
    }
  }
  for (std::size_t i = 0; i < 24; ++i) v[i].lanes.copy_from(places[i], std::experimental::element_aligned);
  for (std::size_t k = 0; k < 3; ++k) origin[k] = v[k];
  for (std::size_t i = 0; i < 24; ++i) v[i] -= origin[i % 3];
  std::array<P, 24> y;
  multiply_anchored(block.matrix, v, y);
  if (block.pull != nullptr) add_pull(block.pull, origin, v, y);
  for (std::size_t i = 0; i < 24; ++i) store(y[i], corner_forces + i * kLanes);
}

[[gnu::flatten]] void corner_blocks_block(const LevelBlock& block, float* blocks) {
  std::array<std::array<Floats, 3>, 3> all;  // sum of all anchored 3 x 3 blocks
  for (auto& row : all) row.fill(Floats(0.0));
  for (std::size_t a = 0; a < 21; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const Floats entry = load<Floats>(block.matrix + anchored_index(a, b) * kLanes);
      all[a % 3][b % 3] += entry;
      if (a != b) all[b % 3][a % 3] += entry;
    }
  }
  if (block.pull != nullptr) {
    const auto pull = [&](std::size_t row, std::size_t k) { return load<Floats>(block.pull + (3 * row + k) * kLanes); };
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t k = 0; k < 3; ++k) {
        all[r][k] += pull(r, k);
        for (std::size_t corner = 1; corner < 8; ++corner) all[r][k] -= pull(3 * corner + k, r);
      }
    }
  }
  std::size_t index = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t k = r; k < 3; ++k, ++index) {
        const std::size_t base = 3 * (corner - 1);
        store(corner == 0 ? all[r][k] : load<Floats>(block.matrix + anchored_index(base + k, base + r) * kLanes),
              blocks + index * kLanes);
      }
    }
  }
}

}  // namespace

Kernels kernels() {
  return {.stiffness_product = stiffness_product_block,
          .stiffness_matrices = stiffness_matrices_block,
          .apply = apply_block<float>,
          .apply_double = apply_block<double>,
          .corner_blocks = corner_blocks_block,
          .coarsen = coarsen_block};
}

}  // namespace sprung::multigrid::SPRUNG_INSTRUCTION_SET
