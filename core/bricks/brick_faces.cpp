#include "core/bricks/brick_faces.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sprung {
namespace {

/// Of a brick, on one side.
std::array<int, 4> corners_on(int side) {
  const int axis = side / 2;
  const bool high = side % 2 != 0;
  const int base = high ? 1 << axis : 0;
  const int j = 1 << ((axis + 1) % 3);
  const int k = 1 << ((axis + 2) % 3);
  std::array<int, 4> corners{base, base | j, base | j | k, base | k};
  if (!high) std::swap(corners[1], corners[3]);
  return corners;
}

std::array<int, 4> sorted(std::array<int, 4> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

std::vector<BrickFace> brick_faces(const BrickGrid& grid, const std::vector<bool>& shown) {
  std::vector<BrickFace> faces;
  faces.reserve(6 * grid.nodes.size());
  for (std::size_t brick = 0; brick < grid.nodes.size(); ++brick) {
    if (!shown[brick]) continue;
    for (int side = 0; side < 6; ++side) {
      BrickFace face{.nodes = {}, .side = side, .brick = static_cast<int>(brick)};
      const std::array<int, 4> corners = corners_on(side);
      for (std::size_t c = 0; c < 4; ++c) face.nodes[c] = grid.nodes[brick][static_cast<std::size_t>(corners[c])];
      faces.push_back(face);
    }
  }
  return faces;
}

std::vector<BrickFace> outer_faces(const BrickGrid& grid, const std::vector<bool>& shown) {
  std::vector<BrickFace> faces = brick_faces(grid, shown);
  std::map<std::array<int, 4>, int> uses;
  for (const BrickFace& face : faces) ++uses[sorted(face.nodes)];
  std::erase_if(faces, [&](const BrickFace& face) { return uses[sorted(face.nodes)] > 1; });
  return faces;
}

std::vector<BrickFace> outer_faces(const BrickGrid& grid) {
  return outer_faces(grid, std::vector<bool>(grid.nodes.size(), true));
}

}  // namespace sprung
