#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// The generalised winding number of triangles, closed or not: 1 inside and 0 outside closed, outward-oriented
/// surfaces, a fraction in between where the surface has gaps.
///
/// Distant triangles are approximated by one dipole, near ones are exact (Barill, Dickson, Schmidt, Levin and Jacobson,
/// "Fast Winding Numbers for Soups and Clouds", 2018): error below 0.03. Build: O(n log n); a query takes some
/// microseconds. Queries are thread-safe. Deterministic.
class WindingTree {
 public:
  /// A tree of the triangles whose rows are given.
  WindingTree(const Points& points, const Triangles& triangles, std::vector<int> rows);
  /// A tree of all triangles.
  WindingTree(const Points& points, const Triangles& triangles);

  /// A triangle contributes nothing at points on it.
  [[nodiscard]] double at(const Vec3& position) const;

 private:
  struct Node {
    Vec3 centre = Vec3::Zero();  // area-weighted mean of the triangles
    Vec3 normal = Vec3::Zero();  // sum of the triangles' area vectors
    double reach = 0;            // of the farthest corner from the centre
    int first = 0;               // of rows_
    int count = 0;
    int children = -1;  // the row of the first of two; -1: none
  };
  void build(int node);
  void measure(Node& node) const;
  [[nodiscard]] double near(const Node& node, const Vec3& position) const;

  const Points& points_;
  const Triangles& triangles_;
  std::vector<int> rows_;
  std::vector<Node> nodes_;
};

/// The solid angle of a triangle seen from `position`, positive from behind (Van Oosterom and Strackee 1983); 0 within
/// its plane.
[[nodiscard]] double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& position);

}  // namespace sprung
