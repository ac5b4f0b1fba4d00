#pragma once
#include <vector>

#include "core/types.h"

namespace sprung {

/// The generalised winding number of any triangles, closed or not: 1 inside and 0 outside of what is closed and
/// outward, a fraction that tells how far a point is enclosed where the surface is torn.
///
/// Far triangles count as one dipole, near ones exactly (Barill, Dickson, Schmidt, Levin and Jacobson, "Fast Winding
/// Numbers for Soups and Clouds", 2018): error below 0.03.
/// Build: n log n. A point costs some microseconds. Safe to ask from several threads; deterministic.
class WindingTree {
 public:
  /// Of the triangles whose rows are given.
  WindingTree(const Points& points, const Triangles& triangles, std::vector<int> rows);
  /// Of all triangles.
  WindingTree(const Points& points, const Triangles& triangles);

  /// On a triangle itself, that triangle counts nothing.
  [[nodiscard]] double at(const Vec3& place) const;

 private:
  struct Node {
    Vec3 centre = Vec3::Zero();  // mean of the triangles by area
    Vec3 normal = Vec3::Zero();  // sum of the triangles' area vectors
    double reach = 0;            // of the farthest corner from the centre
    int first = 0;               // of rows_
    int count = 0;
    int children = -1;  // the row of the first of two; -1: none
  };
  void build(int node);
  void measure(Node& node) const;
  [[nodiscard]] double near(const Node& node, const Vec3& place) const;

  const Points& points_;
  const Triangles& triangles_;
  std::vector<int> rows_;
  std::vector<Node> nodes_;
};

/// The solid angle of a triangle seen from a place, positive seen from behind (Van Oosterom and Strackee 1983); 0 from
/// within its plane.
[[nodiscard]] double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& place);

}  // namespace sprung
