// Compiled once for each instruction set; SPRUNG_KERNELS is the name of the one variable it gives.
#include "core/motion/multigrid/kernels.h"

#include <algorithm>
#include <experimental/simd>

namespace sprung::multigrid {

extern const Kernels SPRUNG_KERNELS;

namespace {

/// A type of this file alone, so that no template made for it can be taken for another instruction set's.
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
  friend Pack max(const Pack& a, const Pack& b) { return std::experimental::max(a.lanes, b.lanes); }
  friend Pack step_above_zero(const Pack& a) {
    Lanes step(Number(0));
    where(a.lanes > Number(0), step) = Number(1);
    return step;
  }
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

/// Bricks side by side; the last one is repeated where there are fewer. In single precision the places are taken from
/// the first corner, before they are rounded.
template <class P>
CornerVectors<P> gather(const BlockInput& input, const double* values, int first, int lanes) {
  using Number = typename P::Lanes::value_type;
  alignas(64) Number places[24][P::Lanes::size()];
  for (int lane = 0; lane < lanes; ++lane) {
    const BrickNodes& nodes = input.nodes[std::min(first + lane, input.brick_count - 1)];
    const double* origin = values + 3 * static_cast<std::ptrdiff_t>(nodes[0]);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const double* value = values + 3 * static_cast<std::ptrdiff_t>(nodes[corner]);
      for (std::size_t k = 0; k < 3; ++k) places[3 * corner + k][lane] = static_cast<Number>(value[k] - origin[k]);
    }
  }
  CornerVectors<P> packed;
  for (std::size_t i = 0; i < 24; ++i) packed[i].lanes.copy_from(places[i], std::experimental::element_aligned);
  return packed;
}

std::size_t place_of_directions(int first) {
  return static_cast<std::size_t>(first / kBricksPerBlock) * kDirectionsOfBlock;
}

[[gnu::flatten]] void directions_block(const BlockInput& block, int first, double* directions) {
  const auto x = gather<Doubles>(block, block.positions, first, kBricksPerBlock);
  double* to = directions + place_of_directions(first);
  for (const auto& direction : spring_directions<Doubles>(block.brick_size, x)) {
    for (const Doubles& part : direction) {
      store(part, to);
      to += kBricksPerBlock;
    }
  }
}

[[gnu::flatten]] void stiffness_product_block(const ProductInput& input, int first, double* corner_products) {
  const BlockInput& block = input.block;
  const auto u = gather<Doubles>(block, input.moves, first, kBricksPerBlock);
  CornerVectors<Doubles> product;
  product.fill(Doubles(0.0));
  if (input.damping != 0) {
    const double* from = input.directions + place_of_directions(first);
    SpringDirections<Doubles> directions;
    for (auto& direction : directions) {
      for (Doubles& part : direction) {
        part = load<Doubles>(from);
        from += kBricksPerBlock;
      }
    }
    damping_product<Doubles>(*block.law, directions, u, product);
    for (Doubles& part : product) part = input.damping * part;
  }
  if (input.stiffness != 0) {
    const auto x = gather<Doubles>(block, block.positions, first, kBricksPerBlock);
    CornerVectors<Doubles> whole;
    whole.fill(Doubles(0.0));
    stiffness_product<Doubles>(*block.law, block.brick_size, x, u, whole);
    for (std::size_t i = 0; i < 24; ++i) product[i] += input.stiffness * whole[i];
  }
  const int lanes = std::min(kBricksPerBlock, block.brick_count - first);
  for (int lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t brick = first + lane;
    for (std::size_t i = 0; i < 24; ++i) {
      corner_products[24 * brick + static_cast<int>(i)] =
          block.stiffness_scale[brick] * product[i].lanes[static_cast<std::size_t>(lane)];
    }
  }
}

[[gnu::flatten]] void stiffness_matrices_block(const BlockInput& input, const EdgeCoupling& coupling, double material,
                                               int first, float* matrix, float* volume_ratios) {
  const auto x = gather<Floats>(input, input.positions, first, kLanes);
  const double h = input.brick_size;
  Floats scale(0.0);
  for (int lane = 0; lane < std::min(kLanes, input.brick_count - first); ++lane) {
    scale.lanes[static_cast<std::size_t>(lane)] = static_cast<float>(input.stiffness_scale[first + lane]);
  }
  std::array<Floats, kAnchoredSize> packed;
  anchored_stiffness<Floats>(*input.law, coupling, h, material, x, packed);
  for (std::size_t i = 0; i < kAnchoredSize; ++i) store(scale * packed[i], matrix + i * kLanes);
  store(brick_volume(x) * Floats(1 / (h * h * h)), volume_ratios);
}

/// C v by the anchored part, and what corner 0 feels for it. Three rows at a time: their sums do not wait for each
/// other, and the columns are loaded once for all three.
template <class P>
void multiply_anchored(const float* matrix, const std::array<P, 24>& v, std::array<P, 24>& y) {
  const auto entry = [&](std::size_t a, std::size_t b) { return load<P>(matrix + anchored_index(a, b) * kLanes); };
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
      const Number* value = x + 3 * static_cast<std::ptrdiff_t>(nodes[corner]);
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
  std::size_t place = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t k = r; k < 3; ++k, ++place) {
        const std::size_t base = 3 * (corner - 1);
        store(corner == 0 ? all[r][k] : load<Floats>(block.matrix + anchored_index(base + k, base + r) * kLanes),
              blocks + place * kLanes);
      }
    }
  }
}

using Matrix24 = std::array<std::array<Floats, 24>, 24>;
using Pull = std::array<std::array<Floats, 3>, 24>;

/// One entry of sixteen bricks, each in a block of its own or together with others.
Floats pick(const float* values, std::size_t entries, std::size_t entry, const std::array<int, kLanes>& blocks,
            const std::array<int, kLanes>& lanes) {
  alignas(64) std::array<float, kLanes> picked{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (blocks[i] < 0) continue;
    picked[i] =
        values[(static_cast<std::size_t>(blocks[i]) * entries + entry) * kLanes + static_cast<std::size_t>(lanes[i])];
  }
  return load<Floats>(picked.data());
}

/// The whole matrices of one octant's children of sixteen coarse bricks. False: there are none.
bool pick_children(const FineMatrices& fine, std::span<const Children> bricks, std::size_t octant, Matrix24& matrix,
                   Pull& pull, bool& has_pull) {
  std::array<int, kLanes> blocks;
  std::array<int, kLanes> lanes{};
  std::array<int, kLanes> pulls;
  blocks.fill(-1);
  pulls.fill(-1);
  bool any = false;
  bool any_pull = false;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    const int child = bricks[i][octant];
    if (child < 0) continue;
    any = true;
    blocks[i] = child / kLanes;
    lanes[i] = child % kLanes;
    pulls[i] = fine.pull_of_block[blocks[i]];
    any_pull = any_pull || pulls[i] >= 0;
  }
  if (!any) return false;
  for (std::size_t a = 0; a < 21; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      const Floats entry = pick(fine.matrices, kAnchoredSize, anchored_index(a, b), blocks, lanes);
      matrix[a + 3][b + 3] = entry;
      matrix[b + 3][a + 3] = entry;
    }
  }
  for (std::size_t row = 0; row < 24; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      pull[row][k] = any_pull ? pick(fine.pulls, kPullSize, 3 * row + k, pulls, lanes) : Floats(0.0);
    }
  }
  has_pull = has_pull || any_pull;
  for (std::size_t row = 3; row < 24; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      Floats rest = pull[row][k];
      for (std::size_t corner = 1; corner < 8; ++corner) rest -= matrix[row][3 * corner + k];
      matrix[row][k] = rest;
      matrix[k][row] = rest;
    }
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      Floats rest = pull[row][k];
      for (std::size_t corner = 1; corner < 8; ++corner) rest -= matrix[row][3 * corner + k];
      matrix[row][k] = rest;
    }
  }
  return true;
}

/// Rows of corners to rows of the coarse brick's corners, which the child in that octant hangs between.
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

void transpose(Matrix24& matrix) {
  for (std::size_t a = 0; a < 24; ++a) {
    for (std::size_t b = 0; b < a; ++b) std::swap(matrix[a][b], matrix[b][a]);
  }
}

[[gnu::flatten]] bool coarsen_block(const FineMatrices& fine, std::span<const Children> bricks, float* matrix,
                                    float* pull) {
  Matrix24 child;
  Pull child_pull;
  std::array<Floats, kAnchoredSize> sum;
  Pull pull_sum;
  sum.fill(Floats(0.0));
  for (auto& row : pull_sum) row.fill(Floats(0.0));
  bool has_pull = false;
  for (std::size_t octant = 0; octant < 8; ++octant) {
    if (!pick_children(fine, bricks, octant, child, child_pull, has_pull)) continue;
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

}  // namespace

const Kernels SPRUNG_KERNELS{.directions = directions_block,
                             .stiffness_product = stiffness_product_block,
                             .stiffness_matrices = stiffness_matrices_block,
                             .apply = apply_block<float>,
                             .apply_double = apply_block<double>,
                             .corner_blocks = corner_blocks_block,
                             .coarsen = coarsen_block};

}  // namespace sprung::multigrid
