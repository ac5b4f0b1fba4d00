#include "core/mesh/query/winding_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace sprung {
namespace {

constexpr int kLeaf = 4;      // triangles
constexpr double kFar = 3.0;  // times the reach of a node: the beta of the paper; 2 has twice the error
constexpr double kInPlane = 1e-12;

std::vector<int> all_rows(const Triangles& triangles) {
  std::vector<int> rows(triangles.rows());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

}  // namespace

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& position) {
  const Vec3 u = a - position;
  const Vec3 v = b - position;
  const Vec3 w = c - position;
  const double lu = u.norm();
  const double lv = v.norm();
  const double lw = w.norm();
  const double volume = u.dot(v.cross(w));
  if (std::abs(volume) <= kInPlane * lu * lv * lw) return 0;
  return 2 * std::atan2(volume, lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv);
}

WindingTree::WindingTree(const Points& points, const Triangles& triangles)
    : WindingTree(points, triangles, all_rows(triangles)) {}

WindingTree::WindingTree(const Points& points, const Triangles& triangles, std::vector<int> rows)
    : points_(points), triangles_(triangles), rows_(std::move(rows)) {
  nodes_.push_back({.first = 0, .count = isize(rows_)});
  for (int node = 0; node < isize(nodes_); ++node) build(node);
}

/// Splits a node at the median of its triangles along the longest side.
void WindingTree::build(int node) {
  Node parent = nodes_[node];
  measure(parent);
  if (parent.count > kLeaf) {
    const auto middle = [&](int t, int axis) { return points_(triangles_.row(t), axis).sum(); };
    const auto begin = rows_.begin() + parent.first;
    const auto end = begin + parent.count;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (auto row = begin; row != end; ++row) {
      const Vec3 place(middle(*row, 0), middle(*row, 1), middle(*row, 2));
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const int half = parent.count / 2;
    std::nth_element(begin, begin + half, end,
                     [&](int a, int b) { return std::pair(middle(a, axis), a) < std::pair(middle(b, axis), b); });
    parent.children = isize(nodes_);
    nodes_.push_back({.first = parent.first, .count = half});
    nodes_.push_back({.first = parent.first + half, .count = parent.count - half});
  }
  nodes_[node] = parent;
}

void WindingTree::measure(Node& node) const {
  double area = 0;
  for (int i = node.first; i < node.first + node.count; ++i) {
    const auto corners = triangles_.row(rows_[i]);
    const Vec3 a = points_.row(corners[0]);
    const Vec3 b = points_.row(corners[1]);
    const Vec3 c = points_.row(corners[2]);
    const Vec3 normal = 0.5 * (b - a).cross(c - a);
    node.normal += normal;
    node.centre += normal.norm() * (a + b + c) / 3;
    area += normal.norm();
  }
  if (area > 0) {
    node.centre /= area;
  } else {
    node.centre = points_.row(triangles_(rows_[node.first], 0));
  }
  for (int i = node.first; i < node.first + node.count; ++i) {
    for (const int corner : triangles_.row(rows_[i])) {
      node.reach = std::max(node.reach, (points_.row(corner).transpose() - node.centre).norm());
    }
  }
}

double WindingTree::near(const Node& node, const Vec3& position) const {
  double angle = 0;
  for (int i = node.first; i < node.first + node.count; ++i) {
    const auto corners = triangles_.row(rows_[i]);
    angle += solid_angle(points_.row(corners[0]), points_.row(corners[1]), points_.row(corners[2]), position);
  }
  return angle;
}

double WindingTree::at(const Vec3& position) const {
  double angle = 0;
  std::array<int, 64> stack{};  // halving leaves no more than 32 levels of one node each
  std::size_t depth = 1;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    const Vec3 away = node.centre - position;
    const double distance = away.norm();
    if (distance > kFar * node.reach) {
      angle += away.dot(node.normal) / (distance * distance * distance);
    } else if (node.children < 0) {
      angle += near(node, position);
    } else {
      stack[depth++] = node.children;
      stack[depth++] = node.children + 1;
    }
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace sprung
