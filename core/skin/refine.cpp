#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/mesh/repair/weld.h"
#include "core/skin/skin.h"
#include "core/unit_rows.h"

namespace sprung {
namespace {

constexpr double kSeamCosine = 0.94;    // normals on both sides of an edge that agree to 20 degrees are one
constexpr double kSteepCosine = 0.5;    // edges steeper than 60 degrees on their normals stay straight
constexpr double kShortestEdge = 30;    // tolerances: shorter edges are not halved
constexpr int kMaxPasses = 6;           // halvings of an edge: curves over a crumpled mesh need not converge ...
constexpr int kMaxTriangles = 1 << 19;  // ... and from here on they are not refined further
constexpr double kSliverLength = 8;     // largest edges: longer triangles ...
constexpr double kSliverWidth = 0.5;    // ... and narrower ones are cut across at once

/// From one end of an edge to the other: a cubic by its ends and the derivatives there, over [0, 1].
struct EdgeCurve {
  Vec3 from, to;
  Vec3 from_slope, to_slope;

  [[nodiscard]] Vec3 chord() const { return to - from; }
  [[nodiscard]] Vec3 middle() const { return (from + to) / 2 + (from_slope - to_slope) / 8; }
  [[nodiscard]] Vec3 middle_slope() const { return 1.5 * chord() - (from_slope + to_slope) / 4; }
  /// About the largest distance between curve and chord: that of an arc of a circle with the steeper end's slope.
  [[nodiscard]] double height() const {
    return std::max((from_slope - chord()).norm(), (to_slope - chord()).norm()) / 4;
  }
};

/// The derivative of a curve with that chord at an end where the triangles on its two sides have these normals: at
/// right angles to both. With a length of 2 / (1 + cos a) chords, for an angle a between chord and slope, the middle of
/// an arc of a circle is exact.
Vec3 slope(const Vec3& chord, const Vec3& left, const Vec3& right) {
  const Vec3 mean = (left + right).normalized();
  const Vec3 crease = left.cross(right).normalized();
  const Vec3 along =
      left.dot(right) > kSeamCosine ? Vec3(chord - chord.dot(mean) * mean) : Vec3(chord.dot(crease) * crease);
  const double cosine = along.norm() / std::max(chord.norm(), std::numeric_limits<double>::min());
  const bool is_shallow = cosine >= kSteepCosine;  // false if a file's normals are no numbers
  return !is_shallow ? chord : Vec3(along * (2 / (cosine * (1 + cosine))));
}

/// Of vertices or points, in any order.
std::uint64_t edge_key(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

/// The curves over a skin's edges, on which the triangles of both sides agree: also at creases and seams, where these
/// have vertices of their own. Edges of more than two triangles are straight.
class EdgeCurves {
 public:
  explicit EdgeCurves(const Skin& skin) : skin_(skin), point_of_(weld_points(skin.positions)) {
    for (const auto& corners : skin.triangles.rowwise()) {
      for (int c = 0; c < 3; ++c) add(corners[c], corners[(c + 1) % 3]);
    }
  }

  /// From the vertex of the lower point to the other.
  [[nodiscard]] EdgeCurve operator()(int a, int b) const {
    if (point_of_[a] > point_of_[b]) std::swap(a, b);
    const Vec3 from = skin_.positions.row(a);
    const Vec3 to = skin_.positions.row(b);
    EdgeCurve curve{.from = from, .to = to, .from_slope = to - from, .to_slope = to - from};
    const auto found = sides_.find(edge_key(point_of_[a], point_of_[b]));
    if (found == sides_.end() || found->second.count > 2) return curve;
    const Sides& sides = found->second;
    const auto normal = [&](int vertex) -> Vec3 { return skin_.normals.row(vertex); };
    const std::array<int, 2> left = sides.vertices[0];
    const std::array<int, 2> right = sides.vertices[sides.count - 1];
    curve.from_slope = slope(curve.chord(), normal(left[0]), normal(right[0]));
    curve.to_slope = slope(curve.chord(), normal(left[1]), normal(right[1]));
    return curve;
  }

 private:
  struct Sides {
    std::array<std::array<int, 2>, 2> vertices{};  // at the lower point and at the other, by triangle
    std::size_t count = 0;
  };

  void add(int a, int b) {
    if (point_of_[a] > point_of_[b]) std::swap(a, b);
    Sides& sides = sides_[edge_key(point_of_[a], point_of_[b])];
    if (sides.count < 2) sides.vertices[sides.count] = {a, b};
    ++sides.count;
  }

  const Skin& skin_;
  std::vector<int> point_of_;
  std::unordered_map<std::uint64_t, Sides> sides_;
};

/// The middle vertices of edges, by edge_key() of their ends.
using Middles = std::unordered_map<std::uint64_t, int>;

/// One pass: every long edge of the skin is halved once; if there are curves, those that are further than `tolerance`
/// from their curve, in its middle. Slivers, whose two long sides would multiply by three with every halving, are cut
/// across at once, at the same middles of middles as their neighbours will be.
class Refiner {
 public:
  /// `middles`: kept from pass to pass.
  Refiner(const Skin& skin, double max_edge, Middles& middles, const EdgeCurves* curves = nullptr, double tolerance = 0)
      : skin_(skin), max_squared_(max_edge * max_edge), middles_(middles), curves_(curves), tolerance_(tolerance) {}

  /// False if no edge was too long.
  bool run(Skin& refined) {
    if (skin_.parts.empty()) {
      for (int t = 0; t < skin_.triangles.rows(); ++t) split_triangle(t);
    }
    for (const Part& part : skin_.parts) {
      const auto first = isize(triangles_);
      for (int t = 0; t < part.triangle_count; ++t) split_triangle(part.first_triangle + t);
      refined.parts.push_back(part);
      refined.parts.back().first_triangle = first;
      refined.parts.back().triangle_count = isize(triangles_) - first;
    }
    if (ends_.empty()) return false;
    refined.materials = skin_.materials;
    refined.positions = with_midpoints(skin_.positions);
    refined.normals = with_midpoints(skin_.normals);
    if (curves_ != nullptr) bend(refined);
    refined.normals.bottomRows(isize(ends_)) = unit_rows(refined.normals.bottomRows(isize(ends_)));
    if (skin_.uvs.rows() > 0) refined.uvs = with_midpoints(skin_.uvs);
    if (skin_.colors.rows() > 0) refined.colors = with_midpoints(skin_.colors);
    refined.triangles.resize(isize(triangles_), 3);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (int c = 0; c < 3; ++c) refined.triangles(t, c) = triangles_[t][c];
    }
    return true;
  }

  /// Vertex attributes with those of the midpoints, after run().
  template <class Rows>
  [[nodiscard]] Rows with_midpoints(const Rows& rows) const {
    Rows all(rows.rows() + isize(ends_), rows.cols());
    all.topRows(rows.rows()) = rows;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      all.row(rows.rows() + int(i)) = (all.row(ends_[i][0]) + all.row(ends_[i][1])) / 2;
    }
    return all;
  }

 private:
  /// Moves the new vertices onto the curves, with normals at right angles to them.
  void bend(Skin& refined) const {
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const EdgeCurve curve = (*curves_)(ends_[i][0], ends_[i][1]);
      const Vec3 along = curve.middle_slope().normalized();
      const auto row = skin_.positions.rows() + Eigen::Index(i);
      const Vec3 mean = refined.normals.row(row);
      refined.positions.row(row) = curve.middle();
      refined.normals.row(row) = mean - mean.dot(along) * along;
    }
  }

  [[nodiscard]] bool is_long(int a, int b) const {
    if (!((position_of(a) - position_of(b)).squaredNorm() > max_squared_)) return false;
    return curves_ == nullptr || (*curves_)(a, b).height() > tolerance_;
  }

  /// The middle vertex of an edge, or -1 if it is not halved.
  int middle(int a, int b) {
    if (!is_long(a, b)) return -1;
    const int next = int(skin_.positions.rows()) + isize(ends_);
    const auto [entry, is_new] = middles_.try_emplace(edge_key(a, b), next);
    if (is_new) {
      new_positions_.push_back((position_of(a) + position_of(b)) / 2);
      ends_.push_back({std::min(a, b), std::max(a, b)});
    }
    return entry->second;
  }

  [[nodiscard]] Eigen::RowVector3d position_of(int vertex) const {
    const auto old = int(skin_.positions.rows());
    return vertex < old ? Eigen::RowVector3d(skin_.positions.row(vertex)) : new_positions_[vertex - old];
  }

  /// Whether the triangle is long and narrow; `v` is turned so that its longest edge is the first.
  [[nodiscard]] bool is_sliver(std::array<int, 3>& v) const {
    if (curves_ != nullptr) return false;
    std::array<double, 3> squared{};
    for (std::size_t i = 0; i < 3; ++i) squared[i] = (position_of(v[i]) - position_of(v[(i + 1) % 3])).squaredNorm();
    const auto longest = std::max_element(squared.begin(), squared.end()) - squared.begin();
    if (!(squared[longest] > kSliverLength * kSliverLength * max_squared_)) return false;
    std::rotate(v.begin(), v.begin() + longest, v.end());
    const Vec3 along = position_of(v[1]) - position_of(v[0]);
    const Vec3 aside = position_of(v[2]) - position_of(v[0]);
    return along.cross(aside).squaredNorm() <= kSliverWidth * kSliverWidth * max_squared_ * along.squaredNorm();
  }

  /// Appends the vertices after `a` on an edge up to `b`, which is halved until no part of it is long.
  void add_chain(int a, int b, std::vector<int>& chain) {
    const int between = middle(a, b);
    if (between < 0) {
      chain.push_back(b);
      return;
    }
    add_chain(a, between, chain);
    add_chain(between, b, chain);
  }

  /// Between its longest edge, the first, and the two others.
  void cut_sliver(const std::array<int, 3>& v) {
    std::vector<int> low{v[0]};
    std::vector<int> high{v[0]};
    add_chain(v[0], v[1], low);
    add_chain(v[0], v[2], high);
    add_chain(v[2], v[1], high);
    const Eigen::RowVector3d along = position_of(v[1]) - position_of(v[0]);
    const auto progress = [&](int vertex) { return along.dot(position_of(vertex)); };
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 1 < low.size() || j + 1 < high.size()) {
      const bool is_low = j + 1 == high.size() || (i + 1 < low.size() && progress(low[i + 1]) <= progress(high[j + 1]));
      const std::array<int, 3> next{low[i], is_low ? low[i + 1] : high[j + 1], high[j]};
      ++(is_low ? i : j);
      const bool is_flat = next[0] == next[1] || next[1] == next[2] || next[2] == next[0];  // at its ends
      if (!is_flat) triangles_.push_back(next);
    }
  }

  void split_triangle(int triangle) {
    std::array<int, 3> v{};
    std::array<int, 3> m{};  // m[i]: middle of the edge from v[i] to v[i + 1]
    for (std::size_t i = 0; i < 3; ++i) v[i] = skin_.triangles(triangle, i);
    if (std::array<int, 3> turned = v; is_sliver(turned)) return cut_sliver(turned);
    std::size_t halved = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      m[i] = middle(v[i], v[(i + 1) % 3]);
      halved += m[i] >= 0 ? 1 : 0;
    }
    if (halved == 0) {
      triangles_.push_back(v);
      return;
    }
    if (halved == 3) {
      for (std::size_t i = 0; i < 3; ++i) triangles_.push_back({v[i], m[i], m[(i + 2) % 3]});
      triangles_.push_back(m);
      return;
    }
    split_partly(v, m, halved);
  }

  void split_partly(std::array<int, 3> v, std::array<int, 3> m, std::size_t halved) {
    // Turn the triangle until edge 0 is halved and, of two halved edges, the other one is edge 1.
    while (m[0] < 0 || (halved == 2 && m[1] < 0)) {
      v = {v[1], v[2], v[0]};
      m = {m[1], m[2], m[0]};
    }
    if (halved == 1) {
      triangles_.push_back({v[0], m[0], v[2]});
      triangles_.push_back({m[0], v[1], v[2]});
      return;
    }
    triangles_.push_back({m[0], v[1], m[1]});
    triangles_.push_back({v[0], m[0], m[1]});
    triangles_.push_back({v[0], m[1], v[2]});
  }

  const Skin& skin_;
  double max_squared_;
  Middles& middles_;
  const EdgeCurves* curves_;
  double tolerance_;
  std::vector<std::array<int, 2>> ends_;           // of the edges whose middles are new vertices
  std::vector<Eigen::RowVector3d> new_positions_;  // of these
  std::vector<std::array<int, 3>> triangles_;
};

bool has_edge_longer_than(const Skin& skin, double limit) {
  for (const auto& corners : skin.triangles.rowwise()) {
    for (int c = 0; c < 3; ++c) {
      if ((skin.positions.row(corners[c]) - skin.positions.row(corners[(c + 1) % 3])).norm() > limit) return true;
    }
  }
  return false;
}

}  // namespace

void refine(Skin& skin, double max_edge) {
  Middles middles;
  for (bool again = true; again;) {
    Skin refined;
    again = Refiner(skin, max_edge, middles).run(refined);
    if (again) skin = std::move(refined);
  }
}

void refine_curves(Skin& skin, double tolerance) {
  const double max_edge = kShortestEdge * tolerance;
  Points interpolated = skin.normals;  // look smoother than normals of the curves, which show dents at every edge
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    if (skin.triangles.rows() > kMaxTriangles || !has_edge_longer_than(skin, max_edge)) break;
    const EdgeCurves curves(skin);
    Middles middles;
    Refiner refiner(skin, max_edge, middles, &curves, tolerance);
    Skin refined;
    if (!refiner.run(refined)) break;
    interpolated = unit_rows(refiner.with_midpoints(interpolated));
    skin = std::move(refined);
  }
  skin.normals = interpolated;
}

}  // namespace sprung
