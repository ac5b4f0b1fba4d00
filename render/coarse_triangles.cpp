#include "render/coarse_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace sprung {

namespace {

/// For each of `count` things the first one that has the same key.
template <class Key>
std::vector<int> first_with_same(const std::vector<Key>& keys) {
  std::vector<int> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&keys](int i) { return std::pair(keys[static_cast<std::size_t>(i)], i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<int> first(keys.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto at = static_cast<std::size_t>(order[i]);
    const bool is_new = i == 0 || keys[at] != keys[static_cast<std::size_t>(order[i - 1])];
    first[at] = is_new ? order[i] : first[static_cast<std::size_t>(order[i - 1])];
  }
  return first;
}

/// For each vertex the first one at the same place, give or take rounding.
std::vector<int> welded(const Skin& skin) {
  constexpr double kRounding = 1e-6;  // of the skin's size
  const Vec3 low = skin.positions.colwise().minCoeff();
  const Vec3 high = skin.positions.colwise().maxCoeff();
  const Vec3 middle = 0.5 * (low + high);
  const double step = std::max(kRounding * (high - low).maxCoeff(), 1e-300);
  std::vector<std::array<long, 3>> keys;
  for (const auto& row : skin.positions.rowwise()) {
    const auto key = [&](int k) { return std::lround((row[k] - middle[k]) / step); };
    keys.push_back({key(0), key(1), key(2)});
  }
  return first_with_same(keys);
}

/// Vertices at one place stay together, though a crease or a seam of the UVs divides them: no cracks. Their mean normal
/// counts.
std::vector<int> cluster(const Skin& skin, double cell) {
  const std::vector<int> weld = welded(skin);
  Points normals = Points::Zero(skin.positions.rows(), 3);
  for (int i = 0; i < normals.rows(); ++i) normals.row(weld[static_cast<std::size_t>(i)]) += skin.normals.row(i);
  std::vector<std::array<int, 4>> keys;
  for (const int vertex : weld) {
    std::array<int, 4> key{};
    for (int k = 0; k < 3; ++k) {
      key[static_cast<std::size_t>(k)] = static_cast<int>(std::floor(skin.positions(vertex, k) / cell));
      if (normals(vertex, k) < 0) key[3] |= 1 << k;
    }
    keys.push_back(key);
  }
  return first_with_same(keys);
}

/// A triangle's corners by what stands for them.
std::array<int, 3> corners(const Skin& skin, const std::vector<int>& stand_in, int triangle) {
  std::array<int, 3> corners{};
  for (int k = 0; k < 3; ++k) {
    corners[static_cast<std::size_t>(k)] = stand_in[static_cast<std::size_t>(skin.triangles(triangle, k))];
  }
  return corners;
}

bool is_flat(const std::array<int, 3>& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

bool is_closed(const Skin& skin) {
  const std::vector<int> weld = welded(skin);
  std::vector<std::array<int, 3>> edges;  // low vertex, high vertex, direction
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    const std::array<int, 3> c = corners(skin, weld, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = c[k];
      const int to = c[(k + 1) % 3];
      if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end());
  int balance = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    balance += edges[i][2];
    const bool is_last = i + 1 == edges.size() || edges[i + 1][0] != edges[i][0] || edges[i + 1][1] != edges[i][1];
    if (is_last && balance != 0) return false;
  }
  return true;
}

double volume(const Skin& skin) {
  double volume = 0;
  const Vec3 middle = skin.positions.colwise().mean();
  for (const auto& row : skin.triangles.rowwise()) {
    const auto corner = [&](int k) -> Vec3 { return skin.positions.row(row[k]).transpose() - middle; };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return volume;
}

}  // namespace

CoarseTriangles coarse_triangles(const Skin& skin, double cell) {
  const std::vector<int> stand_in = cluster(skin, cell);
  CoarseTriangles coarse;
  coarse.triangles.resize(skin.triangles.rows(), 3);
  int count = 0;
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    coarse.first.push_back(count);
    const std::array<int, 3> c = corners(skin, stand_in, t);
    if (!is_flat(c)) coarse.triangles.row(count++) << c[0], c[1], c[2];
  }
  coarse.first.push_back(count);
  coarse.triangles.conservativeResize(count, 3);
  return coarse;
}

Sides visible_sides(const Skin& skin) {
  if (skin.triangles.rows() == 0 || !is_closed(skin)) return Sides::kBoth;
  return volume(skin) > 0 ? Sides::kFront : Sides::kBack;
}

}  // namespace sprung
