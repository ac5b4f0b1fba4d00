#include "core/mesh/stitch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/disjoint_sets.h"

namespace sprung {
namespace {

constexpr double kOfShortestSide = 0.25;
constexpr double kOfDiagonal = 1e-3;

/// For each point the distance within which it may be joined: 0 away from open sides.
std::vector<double> reaches(const std::vector<OpenSide>& open, const WeldedMesh& mesh) {
  std::vector<bool> is_open(static_cast<std::size_t>(mesh.points.rows()), false);
  for (const OpenSide& side : open) is_open[static_cast<std::size_t>(side.from)] = true;
  std::vector<double> reach(is_open.size(), std::numeric_limits<double>::infinity());
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(t, k);
      const int b = mesh.triangles(t, (k + 1) % 3);
      const double length = kOfShortestSide * (mesh.points.row(a) - mesh.points.row(b)).norm();
      for (const int end : {a, b})
        reach[static_cast<std::size_t>(end)] = std::min(reach[static_cast<std::size_t>(end)], length);
    }
  }
  const double most = kOfDiagonal * (mesh.points.colwise().maxCoeff() - mesh.points.colwise().minCoeff()).norm();
  for (std::size_t p = 0; p < reach.size(); ++p) reach[p] = is_open[p] ? std::min(reach[p], most) : 0;
  return reach;
}

/// For each point the one that it becomes. Sweeps along x over the points on open sides.
std::vector<int> find_partners(const Points& points, const std::vector<double>& reach) {
  std::vector<int> order;
  for (int p = 0; p < points.rows(); ++p) {
    if (reach[static_cast<std::size_t>(p)] > 0) order.push_back(p);
  }
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::tuple(points(a, 0), a) < std::tuple(points(b, 0), b); });
  std::vector<int> partner(reach.size());
  std::iota(partner.begin(), partner.end(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int a = order[i];
    const double reach_a = reach[static_cast<std::size_t>(a)];
    for (std::size_t j = i + 1; j < order.size() && points(order[j], 0) - points(a, 0) < reach_a; ++j) {
      const int b = order[j];
      const double distance = (points.row(a) - points.row(b)).norm();
      if (distance >= std::min(reach_a, reach[static_cast<std::size_t>(b)])) continue;
      int& of_later = partner[static_cast<std::size_t>(std::max(a, b))];
      of_later = std::min(of_later, std::min(a, b));
    }
  }
  // Partners come before what joins them, so those are settled already.
  for (int& to : partner) to = partner[static_cast<std::size_t>(to)];
  return partner;
}

}  // namespace

int stitch(const std::vector<OpenSide>& open, WeldedMesh& mesh) {
  const std::vector<int> partner = find_partners(mesh.points, reaches(open, mesh));
  int joined = 0;
  for (std::size_t p = 0; p < partner.size(); ++p) {
    if (partner[p] != static_cast<int>(p)) ++joined;
  }
  if (joined == 0) return 0;
  int kept = 0;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) mesh.triangles(kept, k) = partner[static_cast<std::size_t>(mesh.triangles(t, k))];
    const auto row = mesh.triangles.row(kept);
    if (row[0] == row[1] || row[1] == row[2] || row[2] == row[0]) continue;
    mesh.source[static_cast<std::size_t>(kept)] = mesh.source[static_cast<std::size_t>(t)];
    mesh.turned[static_cast<std::size_t>(kept)] = mesh.turned[static_cast<std::size_t>(t)];
    ++kept;
  }
  mesh.triangles.conservativeResize(kept, 3);
  mesh.source.resize(static_cast<std::size_t>(kept));
  mesh.turned.resize(static_cast<std::size_t>(kept));
  return joined;
}

}  // namespace sprung
