#include "render/stage/coarse_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "render/stage/visible_sides.h"

namespace sprung {
namespace {

/// Vertices at one position are merged across creases and UV seams, by their mean normal, so that no cracks open.
std::vector<int> cluster(const Skin& skin, double cell) {
  const std::vector<int> weld = welded(skin);
  Points normals = Points::Zero(skin.positions.rows(), 3);
  for (int i = 0; i < normals.rows(); ++i) normals.row(weld[i]) += skin.normals.row(i);
  std::vector<std::array<int, 4>> keys;
  for (const int vertex : weld) {
    std::array<int, 4> key{};
    for (int k = 0; k < 3; ++k) {
      key[k] = int(std::floor(skin.positions(vertex, k) / cell));
      if (normals(vertex, k) < 0) key[3] |= 1 << k;
    }
    keys.push_back(key);
  }
  return first_with_same(keys);
}

/// A triangle's corners, replaced by their representatives.
std::array<int, 3> corners(const Skin& skin, const std::vector<int>& stand_in, int triangle) {
  std::array<int, 3> corners{};
  for (int k = 0; k < 3; ++k) {
    corners[k] = stand_in[skin.triangles(triangle, k)];
  }
  return corners;
}

bool is_flat(const std::array<int, 3>& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

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

CoarseTriangles coarse_or_all_triangles(const Skin& skin, double cell) {
  constexpr double kFewest = 0.01;  // of the triangles
  CoarseTriangles coarse = coarse_triangles(skin, std::max(cell, 1e-12));
  const std::size_t all = skin.triangles.rows();
  if (double(coarse.triangles.rows()) >= kFewest * double(all)) return coarse;
  coarse.triangles = skin.triangles;
  coarse.first.resize(all + 1);
  std::iota(coarse.first.begin(), coarse.first.end(), 0);
  return coarse;
}

double skin_radius(const Skin& skin) {
  return skin.positions.rows() == 0 ? 0 : 0.5 * bounding_box(skin.positions).diagonal().norm();
}

}  // namespace sprung
