#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "assets/models/mesh_model.h"

namespace sprung::models {
namespace {

using Cell = std::array<int, 3>;

/// Numbers the lattice points of a box's surface as they are asked for.
struct Lattice {
  std::map<Cell, int> numbers;
  std::vector<Cell> points;

  int number(const Cell& point) {
    const auto [it, added] = numbers.try_emplace(point, isize(points));
    if (added) points.push_back(point);
    return it->second;
  }
};

/// The two faces across `axis`, with u, v, axis right-handed.
void add_faces(const Cell& counts, std::size_t axis, Lattice& lattice, std::vector<Eigen::RowVector3i>& triangles) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  for (const int level : {0, counts[axis]}) {
    for (int i = 0; i < counts[u]; ++i) {
      for (int j = 0; j < counts[v]; ++j) {
        const auto at = [&](int du, int dv) {
          Cell point{};
          point[axis] = level;
          point[u] = i + du;
          point[v] = j + dv;
          return lattice.number(point);
        };
        const int a = at(0, 0);
        const int b = at(1, 0);
        const int c = at(1, 1);
        const int d = at(0, 1);
        const bool high = level > 0;
        triangles.emplace_back(a, high ? b : c, high ? c : b);
        triangles.emplace_back(a, high ? c : d, high ? d : c);
      }
    }
  }
}

}  // namespace

Toy make_box(const Vec3& size, double cell, const Color& color) {
  Cell counts{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    counts[axis] = int(std::lround(size[axis] / cell));
  }
  Lattice lattice;
  std::vector<Eigen::RowVector3i> triangles;
  for (std::size_t axis = 0; axis < 3; ++axis) add_faces(counts, axis, lattice, triangles);

  Toy toy;
  const auto count = Eigen::Index(lattice.points.size());
  toy.positions.resize(count, 3);
  toy.colors.resize(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    const Cell& point = lattice.points[row];
    const Vec3 share(double(point[0]) / counts[0] - 0.5, double(point[1]) / counts[1],
                     double(point[2]) / counts[2] - 0.5);
    toy.positions.row(row) = share.cwiseProduct(size).cast<float>();
    toy.colors.row(row) = (255 * color).array().round().cast<unsigned char>();
  }
  toy.triangles.resize(triangles.size(), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) toy.triangles.row(t) = triangles[t];
  return toy;
}

}  // namespace sprung::models
