#include "core/mesh/read/polygon.h"

#include <Eigen/Geometry>

namespace sprung {
namespace {

using Plane2 = Eigen::Vector2d;

/// Twice the signed area of a triangle.
double cross(const Plane2& a, const Plane2& b, const Plane2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The polygon seen along its area vector (Newell), so that it winds counter-clockwise.
std::vector<Plane2> flatten(const Points& points, std::span<const int> polygon) {
  const Vec3 origin = points.row(polygon[0]);
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 a = points.row(polygon[i]).transpose() - origin;
    const Vec3 b = points.row(polygon[i + 1]).transpose() - origin;
    normal += a.cross(b);
  }
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.normalized().cross(u);
  std::vector<Plane2> flat;
  for (const int corner : polygon) {
    const Vec3 p = points.row(corner).transpose() - origin;
    flat.emplace_back(p.dot(u), p.dot(v));
  }
  return flat;
}

bool is_convex(const std::vector<Plane2>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (cross(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0) return false;
  }
  return true;
}

/// What is left of a polygon while ears are cut off; numbers are places in the polygon.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Plane2>& flat) : flat_(flat) {
    for (std::size_t i = 0; i < flat.size(); ++i) left_.push_back(i);
  }
  [[nodiscard]] std::size_t size() const { return left_.size(); }

  /// Where no corner is an ear (a polygon that crosses itself), the roundest corner goes, so that all are used up. One
  /// of thousands of corners that crosses itself all over would take hours: it ends as a fan.
  std::array<std::size_t, 3> cut() {
    std::size_t best = left_.size() - 1;
    double best_area = -1e300;
    for (std::size_t i = 0; i < left_.size() && tests_ < kMostTests; ++i) {
      const auto [a, b, c] = corner(i);
      const double area = cross(flat_[a], flat_[b], flat_[c]);
      if (area > 0 && is_empty(i)) {
        best = i;
        break;
      }
      if (area > best_area) {
        best = i;
        best_area = area;
      }
    }
    const auto ear = corner(best);
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(best));
    return ear;
  }

 private:
  [[nodiscard]] std::array<std::size_t, 3> corner(std::size_t i) const {
    const std::size_t n = left_.size();
    return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
  }

  [[nodiscard]] bool is_empty(std::size_t i) {
    const auto [a, b, c] = corner(i);
    for (const std::size_t p : left_) {
      ++tests_;
      if (p == a || p == b || p == c) continue;
      if (cross(flat_[a], flat_[b], flat_[p]) >= 0 && cross(flat_[b], flat_[c], flat_[p]) >= 0 &&
          cross(flat_[c], flat_[a], flat_[p]) >= 0) {
        return false;
      }
    }
    return true;
  }

  static constexpr long kMostTests = 100'000'000;  // half a second

  const std::vector<Plane2>& flat_;
  std::vector<std::size_t> left_;
  long tests_ = 0;
};

}  // namespace

void cut_polygon(const Points& points, std::span<const int> polygon, std::vector<std::array<int, 3>>& triangles) {
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  };
  if (polygon.size() == 3) return add(0, 1, 2);
  const std::vector<Plane2> flat = flatten(points, polygon);
  if (is_convex(flat)) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) add(0, i, i + 1);
    return;
  }
  EarClipper clipper(flat);
  while (clipper.size() >= 3) {
    const auto [a, b, c] = clipper.cut();
    add(a, b, c);
  }
}

}  // namespace sprung
