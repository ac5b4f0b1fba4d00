#include "render/stage/visible_sides.h"

#include <array>
#include <cmath>

#include "core/types.h"

namespace sprung {

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

namespace {

bool is_closed(const Skin& skin) {
  const std::vector<int> weld = welded(skin);
  std::vector<std::array<int, 3>> edges;  // low vertex, high vertex, direction
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    const auto corner = [&](int k) { return weld[skin.triangles(t, k)]; };
    for (int k = 0; k < 3; ++k) {
      const int from = corner(k);
      const int to = corner((k + 1) % 3);
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

Sides visible_sides(const Skin& skin) {
  if (skin.triangles.rows() == 0 || !is_closed(skin)) return Sides::kBoth;
  return volume(skin) > 0 ? Sides::kFront : Sides::kBack;
}

}  // namespace sprung
