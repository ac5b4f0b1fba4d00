#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "core/bricks/brick_topology.h"
#include "core/law/brick_law.h"

namespace sprung {

/// One brick, or several side by side: T is double or a pack of doubles. Coordinates run corner by corner, x y z.
template <class T>
using CornerVectors = std::array<T, 24>;

namespace detail {

template <class T>
struct Spring {
  std::array<T, 3> direction;  // unit, from the first corner to the second
  T stretch;                   // m
};

template <class T>
std::array<T, 3> between(const CornerVectors<T>& x, CornerPair pair) {
  const std::size_t a = 3 * pair.from;
  const std::size_t b = 3 * pair.to;
  return {x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]};
}

template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Stretch as (L^2 - rest^2) / (L + rest): the difference of two nearly equal lengths would lose half its digits.
template <class T>
Spring<T> measure(const std::array<T, 3>& vector, double rest) {
  using std::sqrt;
  const T squared = dot(vector, vector);
  const T length = sqrt(squared);
  const T inverse = T(1.0) / length;
  return {{vector[0] * inverse, vector[1] * inverse, vector[2] * inverse}, (squared - rest * rest) / (length + rest)};
}

template <class T>
void pull(CornerVectors<T>& force, CornerPair pair, const std::array<T, 3>& direction, const T& tension) {
  for (std::size_t k = 0; k < 3; ++k) {
    const T part = tension * direction[k];
    force[3 * pair.from + k] += part;
    force[3 * pair.to + k] -= part;
  }
}

/// Tensions of the twelve edges for their stretches (both N and m, edge by edge): the springs and the axial correction
/// on the mean stretches. Linear and symmetric.
template <class T>
std::array<T, 12> edge_tensions(const BrickLaw& law, const std::array<T, 12>& stretch) {
  std::array<T, 3> mean;
  for (std::size_t i = 0; i < 3; ++i) {
    const T* s = &stretch[4 * i];
    mean[i] = 0.25 * ((s[0] + s[1]) + (s[2] + s[3]));
  }
  std::array<T, 12> tension;
  for (std::size_t i = 0; i < 3; ++i) {
    const T axial = 0.25 * (law.axial_self * mean[i] + law.axial_cross * (mean[(i + 1) % 3] + mean[(i + 2) % 3]));
    for (std::size_t e = 4 * i; e < 4 * i + 4; ++e) tension[e] = law.edge * stretch[e] + axial;
  }
  return tension;
}

/// The brick's mean axes: for each direction the mean of its four edges, m.
template <class T>
std::array<std::array<T, 3>, 3> mean_axes(const CornerVectors<T>& x) {
  std::array<std::array<T, 3>, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t c = 0; c < 3; ++c) axes[i][c] = T(0.0);
    for (int side = 0; side < 4; ++side) {
      const auto edge = between(x, brick_edge(int(i), side));
      for (std::size_t c = 0; c < 3; ++c) axes[i][c] += 0.25 * edge[c];
    }
  }
  return axes;
}

/// Adds the corner forces of a tension along each mean axis: a quarter of it in each of its edges.
template <class T>
void pull_axes(CornerVectors<T>& force, const std::array<std::array<T, 3>, 3>& pulls) {
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const double side = on_high_side(corner, axis) ? -0.25 : 0.25;
      for (std::size_t k = 0; k < 3; ++k) {
        force[3 * corner + k] += side * pulls[axis][k];
      }
    }
  }
}

/// The energy of the correction on the mean axes; adds its forces. `rates` as in brick_forces.
template <class T>
T axes_energy(const BrickLaw& law, double h, const CornerVectors<T>& x, const CornerVectors<T>* rates,
              CornerVectors<T>& force) {
  const auto axes = mean_axes(x);
  const std::array<Spring<T>, 3> springs{measure(axes[0], h), measure(axes[1], h), measure(axes[2], h)};
  const T stretch = springs[0].stretch + springs[1].stretch + springs[2].stretch;
  T driving = stretch;
  if (rates != nullptr) {
    const auto rate_axes = mean_axes(*rates);
    for (std::size_t i = 0; i < 3; ++i) driving += dot(springs[i].direction, rate_axes[i]);
  }
  std::array<std::array<T, 3>, 3> pulls;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) pulls[i][k] = law.axes * driving * springs[i].direction[k];
  }
  pull_axes(force, pulls);
  return 0.5 * law.axes * stretch * stretch;
}

}  // namespace detail

/// Elastic energy (J) of full bricks of side h with corners at x (m); adds the forces (N) to `force`.
/// If `rates` is given, it holds beta times the corner velocities (m): each spring's tension then follows stretch +
/// beta * rate of stretch. The energy excludes that part.
template <class T>
T brick_forces(const BrickLaw& law, double h, const CornerVectors<T>& x, const CornerVectors<T>* rates,
               CornerVectors<T>& force) {
  const auto lagged = [rates](const detail::Spring<T>& spring, CornerPair pair) {
    return rates == nullptr ? spring.stretch
                            : spring.stretch + detail::dot(spring.direction, detail::between(*rates, pair));
  };
  T energy(0.0);

  std::array<detail::Spring<T>, 12> edges;
  std::array<T, 12> stretch;
  std::array<T, 12> driving;
  for (std::size_t e = 0; e < 12; ++e) {
    edges[e] = detail::measure(detail::between(x, kEdges[e]), h);
    stretch[e] = edges[e].stretch;
    driving[e] = lagged(edges[e], kEdges[e]);
  }
  const std::array<T, 12> elastic = detail::edge_tensions(law, stretch);
  for (std::size_t e = 0; e < 12; ++e) energy += 0.5 * elastic[e] * stretch[e];
  const std::array<T, 12> tension = rates == nullptr ? elastic : detail::edge_tensions(law, driving);
  for (std::size_t e = 0; e < 12; ++e) detail::pull(force, kEdges[e], edges[e].direction, tension[e]);

  const auto diagonals = [&](const auto& pairs, double rest, double stiffness) {
    if (stiffness == 0) return;
    for (const CornerPair pair : pairs) {
      const detail::Spring<T> spring = detail::measure(detail::between(x, pair), rest);
      energy += 0.5 * stiffness * spring.stretch * spring.stretch;
      detail::pull(force, pair, spring.direction, T(stiffness * lagged(spring, pair)));
    }
  };
  diagonals(kFaceDiagonals, std::numbers::sqrt2 * h, law.face);
  diagonals(kInnerDiagonals, std::numbers::sqrt3 * h, law.inner);

  return law.axes == 0 ? energy : energy + detail::axes_energy(law, h, x, rates, force);
}

}  // namespace sprung
