#include "core/mesh/shells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace sprung {
namespace {

/// A side of a triangle; the two ends in ascending order, so that equal edges sort together.
struct Side {
  int low;
  int high;
  int triangle;
  bool forward;  // the triangle runs from low to high
};

struct Neighbour {
  int triangle;
  bool agrees;  // the two triangles run through their edge in opposite directions
};

class DisjointSets {
 public:
  explicit DisjointSets(Eigen::Index count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int of) {
    while (parent(of) != of) of = parent(of) = parent(parent(of));
    return of;
  }
  void join(int a, int b) { parent(root(a)) = root(b); }

 private:
  int& parent(int of) { return parent_[static_cast<std::size_t>(of)]; }
  std::vector<int> parent_;
};

std::vector<Side> sorted_sides(const Triangles& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * static_cast<std::size_t>(triangles.rows()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k);
      const int b = triangles(t, (k + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

int count_loops(const std::vector<Side>& open, Eigen::Index points) {
  DisjointSets sets(points);
  for (const Side& side : open) sets.join(side.low, side.high);
  std::vector<int> roots;
  roots.reserve(open.size());
  for (const Side& side : open) roots.push_back(sets.root(side.low));
  std::sort(roots.begin(), roots.end());
  return static_cast<int>(std::unique(roots.begin(), roots.end()) - roots.begin());
}

/// Neighbours across edges of exactly two triangles; the other edges are counted as faults.
std::vector<std::vector<Neighbour>> find_neighbours(const Triangles& triangles, Eigen::Index points,
                                                    EdgeFaults& faults) {
  const std::vector<Side> sides = sorted_sides(triangles);
  std::vector<std::vector<Neighbour>> neighbours(static_cast<std::size_t>(triangles.rows()));
  std::vector<Side> open;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    const Side& a = sides[begin];
    while (end < sides.size() && sides[end].low == a.low && sides[end].high == a.high) ++end;
    if (end - begin == 1) open.push_back(a);
    if (end - begin > 2) ++faults.non_manifold;
    if (end - begin != 2) continue;
    const Side& b = sides[begin + 1];
    neighbours[static_cast<std::size_t>(a.triangle)].push_back({b.triangle, a.forward != b.forward});
    neighbours[static_cast<std::size_t>(b.triangle)].push_back({a.triangle, a.forward != b.forward});
  }
  faults.open = static_cast<int>(open.size());
  faults.loops = count_loops(open, points);
  return neighbours;
}

/// Six times the signed volume between a triangle and the origin.
double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

void measure(const Points& points, const Triangles& triangles, Shell& shell) {
  shell.low = shell.high = points.row(triangles(shell.triangles.front(), 0));
  for (const int t : shell.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = points.row(triangles(t, k));
      shell.low = shell.low.cwiseMin(p);
      shell.high = shell.high.cwiseMax(p);
    }
  }
  const Vec3 centre = 0.5 * (shell.low + shell.high);
  double sum = 0;
  for (const int t : shell.triangles) {
    const auto corner = [&](int k) -> Vec3 { return points.row(triangles(t, k)).transpose() - centre; };
    sum += six_volumes(corner(0), corner(1), corner(2));
  }
  shell.volume = sum / 6;
}

/// Collects the triangles that hang together with `seed`, and which of them must turn over to agree with it.
class ShellWalker {
 public:
  explicit ShellWalker(const std::vector<std::vector<Neighbour>>& neighbours)
      : neighbours_(neighbours), state_(neighbours.size(), State::kUnseen) {}

  [[nodiscard]] bool seen(int triangle) const { return state_[static_cast<std::size_t>(triangle)] != State::kUnseen; }
  [[nodiscard]] bool turns(int triangle) const { return state_[static_cast<std::size_t>(triangle)] == State::kTurned; }
  /// Edges met from both sides whose two triangles cannot agree.
  [[nodiscard]] int one_sided() const { return conflicts_ / 2; }

  std::vector<int> walk(int seed) {
    std::vector<int> shell{seed};
    state(seed) = State::kKept;
    for (std::size_t i = 0; i < shell.size(); ++i) {
      const int from = shell[i];
      for (const auto& [to, agrees] : neighbours_[static_cast<std::size_t>(from)]) {
        const State wanted = turns(from) == agrees ? State::kTurned : State::kKept;
        if (!seen(to)) {
          state(to) = wanted;
          shell.push_back(to);
        } else if (state(to) != wanted) {
          ++conflicts_;
        }
      }
    }
    std::sort(shell.begin(), shell.end());
    return shell;
  }

 private:
  enum class State : std::uint8_t { kUnseen, kKept, kTurned };
  State& state(int triangle) { return state_[static_cast<std::size_t>(triangle)]; }

  const std::vector<std::vector<Neighbour>>& neighbours_;
  std::vector<State> state_;
  int conflicts_ = 0;
};

}  // namespace

Shells find_shells(const Points& points, Triangles& triangles) {
  Shells result;
  const auto neighbours = find_neighbours(triangles, points.rows(), result.faults);
  ShellWalker walker(neighbours);
  for (int seed = 0; seed < triangles.rows(); ++seed) {
    if (walker.seen(seed)) continue;
    Shell shell;
    shell.triangles = walker.walk(seed);
    const auto turning =
        std::count_if(shell.triangles.begin(), shell.triangles.end(), [&](int t) { return walker.turns(t); });
    const bool keep_turned = 2 * turning > static_cast<std::ptrdiff_t>(shell.triangles.size());
    for (const int t : shell.triangles) {
      if (walker.turns(t) == keep_turned) continue;
      std::swap(triangles(t, 1), triangles(t, 2));
      ++result.turned;
    }
    measure(points, triangles, shell);
    result.shells.push_back(std::move(shell));
  }
  result.faults.one_sided = walker.one_sided();
  return result;
}

double winding_number(const Points& points, const Triangles& triangles, const std::vector<int>& rows, const Vec3& at) {
  double angle = 0;
  for (const int t : rows) {
    const auto corner = [&](int k) -> Vec3 { return points.row(triangles(t, k)).transpose() - at; };
    const Vec3 a = corner(0);
    const Vec3 b = corner(1);
    const Vec3 c = corner(2);
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(six_volumes(a, b, c), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace sprung
