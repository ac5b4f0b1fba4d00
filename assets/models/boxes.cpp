#include <algorithm>
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

constexpr double kRounding = 0.6;  // radius of the edges of rounded bars, cm
constexpr double kBorder = 0.06;   // width over which colours change, cm

/// Planes from -size / 2 to size / 2, a cell apart; every one between the ends twice where the colours change there,
/// so that they do so sharply.
std::vector<double> planes_of(double size, double cell, bool sharp) {
  std::vector<double> planes;
  const int count = int(std::lround(size / cell));
  for (int i = 0; i <= count; ++i) {
    const double plane = (double(i) / count - 0.5) * size;
    const bool twice = sharp && i > 0 && i < count;
    if (twice) planes.push_back(plane - kBorder / 2);
    planes.push_back(twice ? plane + kBorder / 2 : plane);
  }
  return planes;
}

/// The number of the band of this width that holds x, from the one that begins at 0.
int band_of(double x, double width) { return int(std::floor(x / width)); }

/// The same upwards from 0.
std::vector<double> raised(std::vector<double> planes) {
  const double bottom = planes.front();
  for (double& plane : planes) plane -= bottom;
  return planes;
}

/// Planes across a rounded bar from -size / 2 to size / 2: a cell apart between its rounded edges, closer on those, and
/// two for each of `borders` and its negative, where the colours change.
std::vector<double> rounded_planes(double size, double cell, const std::vector<double>& borders) {
  const double core = size / 2 - kRounding;
  std::vector<double> planes = {0, core, core + 0.4 * kRounding, size / 2};
  for (double plane = cell; plane < core - cell / 2; plane += cell) planes.push_back(plane);
  for (const double border : borders) {
    std::erase_if(planes, [&](double plane) { return std::abs(plane - border) < kBorder; });
    planes.insert(planes.end(), {border - kBorder / 2, border + kBorder / 2});
  }
  std::vector<double> all;
  for (const double plane : planes) {
    all.push_back(plane);
    if (plane > 0) all.push_back(-plane);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// A box with rounded edges.
Toy make_rounded(const std::array<std::vector<double>, 3>& planes, const std::function<Color(const Vec3&)>& paint) {
  constexpr double kMetres = 0.01;
  Toy toy = make_box(planes, paint);
  Vec3 low;
  Vec3 high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = planes[axis].front() + kRounding;
    high[axis] = planes[axis].back() - kRounding;
  }
  toy.normals.resize(toy.positions.rows(), 3);
  for (Eigen::Index row = 0; row < toy.positions.rows(); ++row) {
    const Vec3 p = toy.positions.row(row).cast<double>().transpose() / kMetres;
    const Vec3 core = p.cwiseMax(low).cwiseMin(high);
    const Vec3 normal = (p - core).normalized();
    toy.positions.row(row) = (kMetres * (core + kRounding * normal)).cast<float>();
    toy.normals.row(row) = normal.cast<float>();
  }
  return toy;
}

}  // namespace

Toy make_box(const std::array<std::vector<double>, 3>& planes, const std::function<Color(const Vec3&)>& paint) {
  constexpr double kMetres = 0.01;
  Cell counts{};
  for (std::size_t axis = 0; axis < 3; ++axis) counts[axis] = isize(planes[axis]) - 1;
  Lattice lattice;
  std::vector<Eigen::RowVector3i> triangles;
  for (std::size_t axis = 0; axis < 3; ++axis) add_faces(counts, axis, lattice, triangles);

  Vec3 middle;
  for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (planes[axis].front() + planes[axis].back()) / 2;
  Toy toy;
  const auto count = Eigen::Index(lattice.points.size());
  toy.positions.resize(count, 3);
  toy.colors.resize(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    const Cell& point = lattice.points[row];
    const Vec3 p(planes[0][point[0]], planes[1][point[1]], planes[2][point[2]]);
    toy.positions.row(row) = (kMetres * p).cast<float>();
    const Vec3 within = middle + 0.999 * (p - middle);  // faces are painted as what lies behind them
    toy.colors.row(row) = (255 * paint(within)).array().round().cast<unsigned char>();
  }
  toy.triangles.resize(triangles.size(), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) toy.triangles.row(t) = triangles[t];
  return toy;
}

Toy make_beam() {
  const std::vector<double> across = planes_of(10, 1.25, false);
  return make_box({planes_of(40, 1.25, false), raised(across), across},
                  [](const Vec3&) { return color_from_hex(0x6FA8C9); });
}

Toy make_plank() {
  const std::vector<double> across = planes_of(4, 1, false);
  return make_box({planes_of(24, 2, true), raised(across), across},
                  [](const Vec3& p) { return color_from_hex(band_of(p.x(), 2) % 2 == 0 ? 0x5B7FA6 : 0xE6E0D0); });
}

Toy make_taffy() {
  const std::vector<double> across = rounded_planes(4, 0.7, {});
  return make_rounded({rounded_planes(16, 1, {1, 3, 5, 7}), raised(across), across}, [](const Vec3& p) {
    return color_from_hex(band_of(p.x() + 1, 2) % 2 == 0 ? 0xD9776C : 0xF2E3C6);
  });
}

Toy make_stick() {
  constexpr double kStripe = 0.95;  // where the stripes begin, from the middle of a face
  const std::vector<double> across = rounded_planes(4, 0.5, {kStripe});
  return make_rounded({rounded_planes(24, 0.6, {}), raised(across), across}, [](const Vec3& p) {
    const bool edge = std::min(std::abs(p.y() - 2), std::abs(p.z())) > kStripe;
    return color_from_hex(edge ? 0xB56A94 : 0xF2E3C6);
  });
}

Toy make_flag() {
  return make_box({planes_of(24, 1, false), raised(planes_of(14, 2, true)), planes_of(1, 1, false)},
                  [](const Vec3& p) { return color_from_hex(band_of(p.y(), 2) % 2 == 0 ? 0xC9727A : 0xF0E6D2); });
}

/// Five courses of blocks, each course half a block further than the one below.
Toy make_wall() {
  constexpr std::array<unsigned, 3> kTones = {0xC98B6B, 0xD9A883, 0xB87562};
  return make_box({planes_of(3, 1, false), raised(planes_of(20, 4, true)), planes_of(20, 2.5, true)},
                  [&](const Vec3& p) {
                    const int course = band_of(p.y(), 4);
                    const int block = band_of(p.z() + 10 + 2.5 * (course % 2), 5);
                    return color_from_hex(kTones[std::size_t(block + course % 2) % kTones.size()]);
                  });
}

}  // namespace sprung::models
