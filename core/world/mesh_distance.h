#pragma once
#include <memory>

#include "core/types.h"

namespace sprung {

/// Signed distances to a closed, outward oriented mesh, by a tree of its triangles' boxes. Cost of a query: logarithmic
/// in the triangles. May be asked by several threads at once.
class MeshDistance {
 public:
  /// `positions` m x 3, `triangles` n x 3, at least one triangle with an area.
  MeshDistance(const Points& positions, const Triangles& triangles);
  ~MeshDistance();
  MeshDistance(const MeshDistance&) = delete;
  MeshDistance& operator=(const MeshDistance&) = delete;

  struct Nearest {
    double distance;  // negative inside
    Vec3 normal;      // unit, outward: the gradient of the distance
  };
  /// Which side of the surface a point is on is told by the normal of the nearest place, at edges and vertices by the
  /// mean of the normals around it, weighted by their angles (J. Baerentzen and H. Aanaes, "Signed distance computation
  /// using the angle weighted pseudonormal", IEEE TVCG 11(3), 2005).
  [[nodiscard]] Nearest nearest(const Vec3& place) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sprung
