#include "core/mesh/repair/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"

namespace sprung {

std::vector<int> weld_points(const Points& positions) {
  const auto key = [&](int v) { return std::tuple(positions(v, 0), positions(v, 1), positions(v, 2)); };
  std::vector<int> order(positions.rows());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  std::vector<int> first(order.size());
  int representative = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || key(order[i]) != key(representative)) representative = order[i];
    first[order[i]] = representative;
  }
  return first;
}

namespace {

/// A triangle by its corners, up to rotation.
struct Corners {
  std::array<int, 3> sorted;
  bool even;  // the corners are in ascending order, up to rotation
  std::size_t triangle;
};

Corners corners_of(const std::array<int, 3>& given, std::size_t triangle) {
  std::array<int, 3> sorted = given;
  std::rotate(sorted.begin(), std::min_element(sorted.begin(), sorted.end()), sorted.end());
  const bool even = sorted[1] < sorted[2];
  if (!even) std::swap(sorted[1], sorted[2]);
  return {sorted, even, triangle};
}

/// Marks the triangles to drop among those with the same three corners.
std::vector<bool> find_repeated(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<Corners> all;
  for (std::size_t t = 0; t < triangles.size(); ++t) all.push_back(corners_of(triangles[t], t));
  std::sort(all.begin(), all.end(), [](const Corners& a, const Corners& b) {
    return std::tie(a.sorted, a.triangle) < std::tie(b.sorted, b.triangle);
  });
  std::vector<bool> repeated(triangles.size(), false);
  std::vector<std::size_t> facing;  // the remaining one of triangles that cancel each other
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    int balance = 0;
    for (; end < all.size() && all[end].sorted == all[begin].sorted; ++end) {
      balance += all[end].even ? 1 : -1;
      if (end > begin) repeated[all[end].triangle] = true;
    }
    if (balance == 0) facing.push_back(all[begin].triangle);
  }
  const auto dropped = std::size_t(std::count(repeated.begin(), repeated.end(), true));
  if (2 * facing.size() < triangles.size() - dropped) {
    for (const std::size_t t : facing) repeated[t] = true;
  }
  return repeated;
}

/// Numbers the points by first use and copies the used ones.
void set_rows(const Points& positions, const std::vector<std::array<int, 3>>& triangles, WeldedMesh& welded) {
  std::vector<int> new_row(positions.rows(), -1);
  std::vector<int> used;
  welded.triangles.resize(isize(triangles), 3);
  for (int t = 0; t < welded.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int vertex = triangles[t][k];
      int& row = new_row[vertex];
      if (row < 0) {
        row = isize(used);
        used.push_back(vertex);
      }
      welded.triangles(t, k) = row;
    }
  }
  welded.points = positions(used, Eigen::all);
}

/// The vertices used by triangles.
int count_used(const SurfaceMesh& mesh) {
  std::vector<bool> used(mesh.positions.rows(), false);
  for (const int vertex : mesh.triangles.reshaped()) used[vertex] = true;
  return int(std::count(used.begin(), used.end(), true));
}

}  // namespace

WeldedMesh weld(const SurfaceMesh& mesh) {
  const std::vector<int> first = weld_points(mesh.positions);
  WeldedMesh welded;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> source;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<int, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      corners[k] = first[mesh.triangles(t, k)];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      ++welded.without_area;
      continue;
    }
    triangles.push_back(corners);
    source.push_back(t);
  }
  const std::vector<bool> repeated = find_repeated(triangles);
  std::vector<std::array<int, 3>> kept;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (repeated[t]) {
      ++welded.repeated;
      continue;
    }
    kept.push_back(triangles[t]);
    welded.source.push_back(source[t]);
  }
  set_rows(mesh.positions, kept, welded);
  welded.flipped.assign(kept.size(), false);
  const int used = count_used(mesh);
  welded.unreferenced = int(mesh.positions.rows()) - used;
  if (welded.without_area + welded.repeated == 0) welded.joined = used - int(welded.points.rows());
  return welded;
}

namespace {

constexpr double kOfShortestSide = 0.25;
constexpr double kOfDiagonal = 1e-3;

/// For each point, the distance within which it may be merged: 0 away from open sides.
std::vector<double> reaches(const std::vector<OpenSide>& open, const WeldedMesh& mesh) {
  std::vector<bool> is_open(mesh.points.rows(), false);
  for (const OpenSide& side : open) is_open[side.from] = true;
  std::vector<double> reach(is_open.size(), std::numeric_limits<double>::infinity());
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(t, k);
      const int b = mesh.triangles(t, (k + 1) % 3);
      const double length = kOfShortestSide * (mesh.points.row(a) - mesh.points.row(b)).norm();
      for (const int end : {a, b}) reach[end] = std::min(reach[end], length);
    }
  }
  const double most = kOfDiagonal * (mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff()).norm();
  for (std::size_t p = 0; p < reach.size(); ++p) reach[p] = is_open[p] ? std::min(reach[p], most) : 0;
  return reach;
}

/// For each point, the one it merges into. Sweeps along x over the points on open sides.
std::vector<int> find_partners(const Points& points, const std::vector<double>& reach) {
  std::vector<int> order;
  for (int p = 0; p < points.rows(); ++p) {
    if (reach[p] > 0) order.push_back(p);
  }
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::tuple(points(a, 0), a) < std::tuple(points(b, 0), b); });
  std::vector<int> partner(reach.size());
  std::iota(partner.begin(), partner.end(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int a = order[i];
    const double reach_a = reach[a];
    for (std::size_t j = i + 1; j < order.size() && points(order[j], 0) - points(a, 0) < reach_a; ++j) {
      const int b = order[j];
      const double distance = (points.row(a) - points.row(b)).norm();
      if (distance >= std::min(reach_a, reach[b])) continue;
      int& of_later = partner[std::max(a, b)];
      of_later = std::min(of_later, std::min(a, b));
    }
  }
  // Targets come before the points that merge into them, so they are final.
  for (int& to : partner) to = partner[to];
  return partner;
}

}  // namespace

int stitch(const std::vector<OpenSide>& open, WeldedMesh& mesh) {
  const std::vector<int> partner = find_partners(mesh.points, reaches(open, mesh));
  int joined = 0;
  for (std::size_t p = 0; p < partner.size(); ++p) {
    if (partner[p] != int(p)) ++joined;
  }
  if (joined == 0) return 0;
  int kept = 0;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) mesh.triangles(kept, k) = partner[mesh.triangles(t, k)];
    const auto row = mesh.triangles.row(kept);
    if (row[0] == row[1] || row[1] == row[2] || row[2] == row[0]) continue;
    mesh.source[kept] = mesh.source[t];
    mesh.flipped[kept] = mesh.flipped[t];
    ++kept;
  }
  mesh.triangles.conservativeResize(kept, 3);
  mesh.source.resize(kept);
  mesh.flipped.resize(kept);
  return joined;
}

}  // namespace sprung
