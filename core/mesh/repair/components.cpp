#include "core/mesh/repair/components.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

namespace sprung {

std::vector<Side> sorted_sides(const Triangles& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * std::size_t(triangles.rows()));
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

EdgePairs::EdgePairs(const Points& points, const Triangles& triangles, const std::vector<int>& pieces)
    : points_(points), triangles_(triangles), pieces_(pieces), sets_(triangles.rows()) {}

void EdgePairs::pair(std::span<const Side> edge) {
  if (edge.size() == 2 && edge[0].forward != edge[1].forward) {
    sets_.merge(edge[0].triangle, edge[1].triangle);
  } else if (edge.size() <= 2) {
    open_.insert(open_.end(), edge.begin(), edge.end());
  } else {
    pair_many(edge);
  }
}

void EdgePairs::pair_many(std::span<const Side> edge) {
  std::vector<Side> around(edge.begin(), edge.end());
  sort_around(around);
  std::set<int> pieces;
  for (const Side& side : around) pieces.insert(piece_of(side));
  std::vector<Side> left;
  for (const int piece : pieces) {
    std::vector<Side> own;
    std::copy_if(around.begin(), around.end(), std::back_inserter(own),
                 [&](const Side& side) { return piece_of(side) == piece; });
    pair_around(own);
    left.insert(left.end(), own.begin(), own.end());
  }
  sort_around(left);
  pair_around(left);
  open_.insert(open_.end(), left.begin(), left.end());
}

/// Seen along the edge, solid begins at a backward side and ends at the next forward one.
void EdgePairs::pair_around(std::vector<Side>& sides) {
  for (std::size_t i = 0; i < sides.size() && sides.size() > 1;) {
    const std::size_t next = (i + 1) % sides.size();
    if (sides[i].forward || !sides[next].forward) {
      ++i;
      continue;
    }
    sets_.merge(sides[i].triangle, sides[next].triangle);
    sides.erase(sides.begin() + std::ptrdiff_t(std::max(i, next)));
    sides.erase(sides.begin() + std::ptrdiff_t(std::min(i, next)));
    i = 0;
  }
}

/// Sorts sides by the angle of their triangles about the edge.
void EdgePairs::sort_around(std::vector<Side>& edge) const {
  if (edge.empty()) return;
  const Vec3 low = points_.row(edge[0].low);
  const Vec3 axis = (points_.row(edge[0].high).transpose() - low).normalized();
  const Vec3 across = axis.unitOrthogonal();
  std::vector<std::pair<double, Side>> angles;
  for (const Side& side : edge) {
    const int apex = triangles_.row(side.triangle).sum() - side.low - side.high;
    const Vec3 out = points_.row(apex).transpose() - low;
    angles.emplace_back(std::atan2(out.dot(axis.cross(across)), out.dot(across)), side);
  }
  std::stable_sort(angles.begin(), angles.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < edge.size(); ++i) edge[i] = angles[i].second;
}

namespace {

struct Neighbour {
  int triangle;
  bool agrees;  // the two triangles run through their edge in opposite directions
};

int count_loops(const std::vector<Side>& open, Eigen::Index points) {
  DisjointSets sets(points);
  for (const Side& side : open) sets.merge(side.low, side.high);
  std::vector<int> roots;
  roots.reserve(open.size());
  for (const Side& side : open) roots.push_back(sets.find(side.low));
  std::sort(roots.begin(), roots.end());
  return int(std::unique(roots.begin(), roots.end()) - roots.begin());
}

/// Across edges of exactly two triangles.
std::vector<std::vector<Neighbour>> find_neighbours(const std::vector<Side>& sides, Eigen::Index triangles) {
  std::vector<std::vector<Neighbour>> neighbours(triangles);
  for_each_edge(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].forward != edge[1].forward;
    neighbours[edge[0].triangle].push_back({edge[1].triangle, agrees});
    neighbours[edge[1].triangle].push_back({edge[0].triangle, agrees});
  });
  return neighbours;
}

/// Six times the signed volume between a triangle and the origin.
double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

/// Collects the triangles connected to `seed`, and which of them must be flipped to agree with it.
class ShellWalker {
 public:
  explicit ShellWalker(const std::vector<std::vector<Neighbour>>& neighbours)
      : neighbours_(neighbours), state_(neighbours.size(), State::kUnseen) {}

  [[nodiscard]] bool seen(int triangle) const { return state_[triangle] != State::kUnseen; }
  [[nodiscard]] bool turns(int triangle) const { return state_[triangle] == State::kTurned; }
  /// Edges reached from both sides whose two triangles cannot agree.
  [[nodiscard]] int one_sided() const { return conflicts_ / 2; }

  std::vector<int> walk(int seed) {
    std::vector<int> shell{seed};
    state(seed) = State::kKept;
    for (std::size_t i = 0; i < shell.size(); ++i) {
      const int from = shell[i];
      for (const auto& [to, agrees] : neighbours_[from]) {
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
  State& state(int triangle) { return state_[triangle]; }

  const std::vector<std::vector<Neighbour>>& neighbours_;
  std::vector<State> state_;
  int conflicts_ = 0;
};

/// Orients each connected component consistently, flipping the minority; returns each triangle's component.
std::vector<int> orient(const std::vector<std::vector<Neighbour>>& neighbours, Triangles& triangles,
                        SurfaceComponents& result) {
  ShellWalker walker(neighbours);
  std::vector<int> pieces(neighbours.size());
  result.flipped.assign(neighbours.size(), false);
  for (int seed = 0; seed < triangles.rows(); ++seed) {
    if (walker.seen(seed)) continue;
    const std::vector<int> piece = walker.walk(seed);
    const auto turning = std::count_if(piece.begin(), piece.end(), [&](int t) { return walker.turns(t); });
    const bool keep_turned = 2 * turning > std::ptrdiff_t(piece.size());
    for (const int t : piece) {
      pieces[t] = seed;
      if (walker.turns(t) == keep_turned) continue;
      std::swap(triangles(t, 1), triangles(t, 2));
      result.flipped[t] = true;
    }
  }
  result.faults.one_sided = walker.one_sided();
  return pieces;
}

void collect_shells(const Points& points, const Triangles& triangles, EdgePairs& pairs, SurfaceComponents& result) {
  std::vector<int> number(triangles.rows(), -1);
  const auto shell_of = [&](int t) -> int& { return number[pairs.shell_of(t)]; };
  for (int t = 0; t < triangles.rows(); ++t) {
    if (shell_of(t) < 0) {
      shell_of(t) = isize(result.shells);
      result.shells.emplace_back();
    }
    result.shells[shell_of(t)].triangles.push_back(t);
  }
  for (SurfaceComponent& shell : result.shells) measure(points, triangles, shell);
  for (const Side& side : pairs.open()) {
    result.open.push_back({side.forward ? side.low : side.high, side.forward ? side.high : side.low, side.triangle,
                           shell_of(side.triangle)});
  }
}

}  // namespace

double triangle_area(const Points& points, const Triangles& triangles, int row) {
  const Vec3 a = points.row(triangles(row, 0));
  const Vec3 b = points.row(triangles(row, 1)).transpose() - a;
  const Vec3 c = points.row(triangles(row, 2)).transpose() - a;
  return 0.5 * b.cross(c).norm();
}

void measure(const Points& points, const Triangles& triangles, SurfaceComponent& shell) {
  shell.bounds.setEmpty();
  for (const int t : shell.triangles) {
    for (int k = 0; k < 3; ++k) shell.bounds.extend(Vec3(points.row(triangles(t, k))));
  }
  const Vec3 centre = shell.bounds.center();
  double sum = 0;
  for (const int t : shell.triangles) {
    const auto corner = [&](int k) -> Vec3 { return points.row(triangles(t, k)).transpose() - centre; };
    sum += six_volumes(corner(0), corner(1), corner(2));
  }
  shell.volume = sum / 6;
}

SurfaceComponents find_shells(const Points& points, Triangles& triangles) {
  SurfaceComponents result;
  std::vector<Side> sides = sorted_sides(triangles);
  const std::vector<int> pieces = orient(find_neighbours(sides, triangles.rows()), triangles, result);
  for (Side& side : sides) {
    if (result.flipped[side.triangle]) side.forward = !side.forward;
  }
  EdgePairs pairs(points, triangles, pieces);
  std::vector<Side> single;
  for_each_edge(sides, [&](std::span<const Side> edge) {
    pairs.pair(edge);
    if (edge.size() == 1) single.push_back(edge[0]);
    if (edge.size() > 2) ++result.faults.non_manifold;
  });
  result.faults.open = isize(single);
  result.faults.loops = count_loops(single, points.rows());
  collect_shells(points, triangles, pairs, result);
  return result;
}

}  // namespace sprung
