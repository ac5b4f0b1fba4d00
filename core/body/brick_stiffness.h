#pragma once
#include "core/body/brick_kernel.h"
#include "core/law/anchored_matrix.h"

namespace sprung {

/// Tensions of the twelve edges for unit stretches, N/m: edge_tensions() as a matrix.
using EdgeCoupling = std::array<std::array<double, 12>, 12>;
[[nodiscard]] inline EdgeCoupling edge_coupling(const BrickLaw& law) {
  EdgeCoupling coupling;
  for (std::size_t e = 0; e < 12; ++e) {
    std::array<double, 12> unit{};
    unit[e] = 1;
    coupling[e] = detail::edge_tensions(law, unit);
  }
  return coupling;
}

namespace detail {

/// Tensions of the three mean axes for their stretches.
template <class T>
std::array<T, 3> axes_tensions(const BrickLaw& law, const std::array<T, 3>& stretch) {
  const T tension = law.axes * (stretch[0] + stretch[1] + stretch[2]);
  return {tension, tension, tension};
}

/// The mean axes' part of stiffness_product().
template <class T>
void add_axes_product(const BrickLaw& law, double h, const CornerVectors<T>& x, const CornerVectors<T>& u,
                      CornerVectors<T>& product) {
  const auto a = mean_axes(x);
  const auto da = mean_axes(u);
  std::array<Spring<T>, 3> springs;
  std::array<T, 3> stretch;
  std::array<T, 3> rates;
  for (std::size_t i = 0; i < 3; ++i) {
    springs[i] = measure(a[i], h);
    stretch[i] = springs[i].stretch;
    rates[i] = dot(springs[i].direction, da[i]);
  }
  const std::array<T, 3> tensions = axes_tensions(law, stretch);
  const std::array<T, 3> tension_rates = axes_tensions(law, rates);
  std::array<std::array<T, 3>, 3> pulls;
  for (std::size_t i = 0; i < 3; ++i) {
    const T sideways = tensions[i] / (stretch[i] + h);
    const T along = tension_rates[i] - sideways * rates[i];
    for (std::size_t c = 0; c < 3; ++c) pulls[i][c] = along * springs[i].direction[c] + sideways * da[i][c];
  }
  CornerVectors<T> force;
  force.fill(T(0.0));
  pull_axes(force, pulls);
  for (std::size_t i = 0; i < 24; ++i) product[i] -= force[i];
}

}  // namespace detail

/// Adds K u (N) to `product`: K the second derivative of the energy of full bricks of side h with corners at x (m), u
/// a displacement of the corners (m).
template <class T>
void stiffness_product(const BrickLaw& law, double h, const CornerVectors<T>& x, const CornerVectors<T>& u,
                       CornerVectors<T>& product) {
  const auto add = [&](CornerPair pair, const detail::Spring<T>& spring, const std::array<T, 3>& du, const T& rate,
                       const T& tension_rate, const T& tension, double rest) {
    const T sideways = tension / (spring.stretch + rest);
    const T along = tension_rate - sideways * rate;
    for (std::size_t k = 0; k < 3; ++k) {
      const T force = along * spring.direction[k] + sideways * du[k];
      product[3 * pair.from + k] -= force;
      product[3 * pair.to + k] += force;
    }
  };
  std::array<detail::Spring<T>, 12> edges;
  std::array<T, 12> stretch;
  std::array<T, 12> rates;
  for (std::size_t e = 0; e < 12; ++e) {
    edges[e] = detail::measure(detail::between(x, kEdges[e]), h);
    stretch[e] = edges[e].stretch;
    rates[e] = detail::dot(edges[e].direction, detail::between(u, kEdges[e]));
  }
  const std::array<T, 12> tension_rates = detail::edge_tensions(law, rates);
  const std::array<T, 12> tensions = detail::edge_tensions(law, stretch);
  for (std::size_t e = 0; e < 12; ++e) {
    add(kEdges[e], edges[e], detail::between(u, kEdges[e]), rates[e], tension_rates[e], tensions[e], h);
  }
  const auto diagonals = [&](const auto& pairs, double rest, double stiffness) {
    if (stiffness == 0) return;
    for (const CornerPair pair : pairs) {
      const detail::Spring<T> spring = detail::measure(detail::between(x, pair), rest);
      const auto du = detail::between(u, pair);
      const T rate = detail::dot(spring.direction, du);
      add(pair, spring, du, rate, stiffness * rate, stiffness * spring.stretch, rest);
    }
  };
  diagonals(kFaceDiagonals, std::numbers::sqrt2 * h, law.face);
  diagonals(kInnerDiagonals, std::numbers::sqrt3 * h, law.inner);
  if (law.axes != 0) detail::add_axes_product(law, h, x, u, product);
}

namespace detail {

/// Adds the terms of coupled edge tensions: sum over edges e, f of coupling_ef d_e d_f^T at their corners.
template <class T>
void add_coupled_edges(const EdgeCoupling& coupling, double material, const std::array<Spring<T>, 12>& edges,
                       std::array<T, kAnchoredSize>& matrix) {
  // The one edge along `axis` that ends at a corner.
  const auto edge_at = [](int corner, int axis) {
    const int j = (axis + 1) % 3;
    const int k = (axis + 2) % 3;
    return 4 * axis + (on_high_side(corner, j) ? 1 : 0) + (on_high_side(corner, k) ? 2 : 0);
  };
  const auto side = [](int corner, int axis) { return on_high_side(corner, axis) ? 1.0 : -1.0; };
  for (int a = 1; a < 8; ++a) {
    for (int b = 1; b <= a; ++b) {
      for (int i = 0; i < 3; ++i) {
        const std::size_t e = edge_at(a, i);
        std::array<T, 3> sum{T(0.0), T(0.0), T(0.0)};
        for (int j = 0; j < 3; ++j) {
          const std::size_t f = edge_at(b, j);
          if (coupling[e][f] == 0) continue;
          const T factor(material * coupling[e][f] * side(a, i) * side(b, j));
          for (std::size_t c = 0; c < 3; ++c) sum[c] += factor * edges[f].direction[c];
        }
        for (std::size_t r = 0; r < 3; ++r) {
          const auto row = std::size_t(3 * (a - 1)) + r;
          for (std::size_t c = 0; c < 3; ++c) {
            const auto column = std::size_t(3 * (b - 1)) + c;
            if (column <= row) matrix[anchored_index(row, column)] += edges[e].direction[r] * sum[c];
          }
        }
      }
    }
  }
}

/// Adds the terms of the correction on the mean axes.
template <class T>
void add_axes(const BrickLaw& law, double h, double material, const CornerVectors<T>& x,
              std::array<T, kAnchoredSize>& matrix) {
  const auto axes = mean_axes(x);
  std::array<Spring<T>, 3> springs;
  std::array<T, 3> stretch;
  for (std::size_t i = 0; i < 3; ++i) {
    springs[i] = measure(axes[i], h);
    stretch[i] = springs[i].stretch;
  }
  const std::array<T, 3> tensions = axes_tensions(law, stretch);
  // By the axes, an entry of corner b already summed over the axes j that it is an end of.
  const auto axis_by_corner = [&](std::size_t i, std::size_t r, std::size_t c, int b) {
    T sum(0.0);
    for (std::size_t j = 0; j < 3; ++j) {
      T entry = material * law.axes * springs[i].direction[r] * springs[j].direction[c];
      if (i == j) {
        const T sideways = tensions[i] / (stretch[i] + h);
        entry -= sideways * springs[i].direction[r] * springs[i].direction[c];
        if (r == c) entry += sideways;
      }
      sum += (on_high_side(b, int(j)) ? 0.0625 : -0.0625) * entry;
    }
    return sum;
  };
  for (int b = 1; b < 8; ++b) {
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::array<T, 3> parts;
        for (std::size_t i = 0; i < 3; ++i) parts[i] = axis_by_corner(i, r, c, b);
        for (int a = b; a < 8; ++a) {
          const auto row = std::size_t(3 * (a - 1)) + r;
          const auto column = std::size_t(3 * (b - 1)) + c;
          if (column > row) continue;
          for (std::size_t i = 0; i < 3; ++i) {
            matrix[anchored_index(row, column)] += (on_high_side(a, int(i)) ? 1.0 : -1.0) * parts[i];
          }
        }
      }
    }
  }
}

/// Adds `along` d d^T + `sideways` (I - d d^T) between two corners.
template <class T>
void add_spring(CornerPair pair, const std::array<T, 3>& d, const T& along, const T& sideways,
                std::array<T, kAnchoredSize>& matrix) {
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      T value = (along - sideways) * d[r] * d[c];
      if (r == c) value += sideways;
      const std::size_t to = 3 * (pair.to - 1);
      if (c <= r) matrix[anchored_index(to + r, to + c)] += value;
      if (pair.from == 0) continue;
      const std::size_t from = 3 * (pair.from - 1);
      if (c <= r) matrix[anchored_index(from + r, from + c)] += value;
      const bool to_is_row = pair.to > pair.from;
      matrix[to_is_row ? anchored_index(to + r, from + c) : anchored_index(from + r, to + c)] -= value;
    }
  }
}

}  // namespace detail

/// K of full bricks of side h with corners at x, as an anchored matrix, N/m; the axial part of the springs times
/// `material`.
template <class T>
void anchored_stiffness(const BrickLaw& law, const EdgeCoupling& coupling, double h, double material,
                        const CornerVectors<T>& x, std::array<T, kAnchoredSize>& matrix) {
  matrix.fill(T(0.0));
  std::array<detail::Spring<T>, 12> edges;
  std::array<T, 12> stretch;
  for (std::size_t e = 0; e < 12; ++e) {
    edges[e] = detail::measure(detail::between(x, kEdges[e]), h);
    stretch[e] = edges[e].stretch;
  }
  detail::add_coupled_edges(coupling, material, edges, matrix);
  const std::array<T, 12> tensions = detail::edge_tensions(law, stretch);
  for (std::size_t e = 0; e < 12; ++e) {
    detail::add_spring(kEdges[e], edges[e].direction, T(0.0), tensions[e] / (stretch[e] + h), matrix);
  }
  const auto diagonals = [&](const auto& pairs, double rest, double stiffness) {
    if (stiffness == 0) return;
    for (const CornerPair pair : pairs) {
      const detail::Spring<T> spring = detail::measure(detail::between(x, pair), rest);
      detail::add_spring(pair, spring.direction, T(material * stiffness),
                         stiffness * spring.stretch / (spring.stretch + rest), matrix);
    }
  };
  diagonals(kFaceDiagonals, std::numbers::sqrt2 * h, law.face);
  diagonals(kInnerDiagonals, std::numbers::sqrt3 * h, law.inner);
  if (law.axes != 0) detail::add_axes(law, h, material, x, matrix);
}

}  // namespace sprung
