#pragma once
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/skin/skin.h"

namespace sprung {

/// For each item the first one with the same key.
template <class Key>
[[nodiscard]] std::vector<int> first_with_same(const std::vector<Key>& keys) {
  std::vector<int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&keys](int i) { return std::pair(keys[i], i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<int> first(keys.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t at = order[i];
    const bool is_new = i == 0 || keys[at] != keys[order[i - 1]];
    first[at] = is_new ? order[i] : first[order[i - 1]];
  }
  return first;
}

/// For each vertex the first one at the same position up to rounding.
[[nodiscard]] std::vector<int> welded(const Skin& skin);

/// Which sides of a skin's triangles are visible.
enum class Sides { kBoth, kFront, kBack };

/// One side if the triangles enclose a solid: every edge has as many triangles on its left as on its right. Vertices
/// that differ by rounding only count as one.
[[nodiscard]] Sides visible_sides(const Skin& skin);

}  // namespace sprung
