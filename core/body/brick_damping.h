#pragma once
#include "core/body/brick_kernel.h"

namespace sprung {

/// Unit vectors along a brick's springs: twelve edges, twelve face diagonals, four inner ones, three mean axes.
inline constexpr std::size_t kFirstFaceDiagonal = 12;
inline constexpr std::size_t kFirstInnerDiagonal = 24;
inline constexpr std::size_t kFirstMeanAxis = 28;
inline constexpr std::size_t kSpringsOfBrick = 31;
template <class T>
using SpringDirections = std::array<std::array<T, 3>, kSpringsOfBrick>;

/// For bricks of side h with corners at x (m).
template <class T>
SpringDirections<T> spring_directions(double h, const CornerVectors<T>& x) {
  SpringDirections<T> directions;
  std::size_t row = 0;
  const auto add = [&](const auto& pairs) {
    for (const CornerPair pair : pairs) directions[row++] = detail::measure(detail::between(x, pair), h).direction;
  };
  add(kEdges);
  add(kFaceDiagonals);
  add(kInnerDiagonals);
  for (const std::array<T, 3>& axis : detail::mean_axes(x)) directions[row++] = detail::measure(axis, h).direction;
  return directions;
}

/// Adds K_along u (N) to `product`: the axial stiffness of the springs of full bricks, as used by damping, without the
/// geometric stiffness of their tensions.
template <class T>
void damping_product(const BrickLaw& law, const SpringDirections<T>& directions, const CornerVectors<T>& u,
                     CornerVectors<T>& product) {
  const auto add = [&](CornerPair pair, const std::array<T, 3>& direction, const T& force) {
    for (std::size_t k = 0; k < 3; ++k) {
      product[3 * pair.from + k] -= force * direction[k];
      product[3 * pair.to + k] += force * direction[k];
    }
  };
  std::array<T, 12> rates;
  for (std::size_t e = 0; e < 12; ++e) rates[e] = detail::dot(directions[e], detail::between(u, kEdges[e]));
  const std::array<T, 12> tensions = detail::edge_tensions(law, rates);
  for (std::size_t e = 0; e < 12; ++e) add(kEdges[e], directions[e], tensions[e]);
  const auto diagonals = [&](const auto& pairs, std::size_t first, double stiffness) {
    if (stiffness == 0) return;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::array<T, 3>& direction = directions[first + i];
      add(pairs[i], direction, stiffness * detail::dot(direction, detail::between(u, pairs[i])));
    }
  };
  diagonals(kFaceDiagonals, kFirstFaceDiagonal, law.face);
  diagonals(kInnerDiagonals, kFirstInnerDiagonal, law.inner);
  if (law.axes == 0) return;
  const auto axes = detail::mean_axes(u);
  T rate(0.0);
  for (std::size_t i = 0; i < 3; ++i) rate += detail::dot(directions[kFirstMeanAxis + i], axes[i]);
  std::array<std::array<T, 3>, 3> pulls;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) pulls[i][k] = T(0.0) - law.axes * rate * directions[kFirstMeanAxis + i][k];
  }
  detail::pull_axes(product, pulls);
}

}  // namespace sprung
