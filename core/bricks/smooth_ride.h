#pragma once
#include <vector>

#include "core/bricks/embedding.h"

namespace sprung {

/// Embedded points and normals as they ride on a field that is smooth across the faces of the bricks, where trilinear
/// interpolation has creases. Each node knows where it is and the mean gradient of its bricks there; these linear maps
/// L_k(p) = x_k + F_k (p - X_k) are blended within each brick,
///   f(p) = sum_k w_k(p) L_k(p),   w_k = products of s or 1 - s along the axes,   s(t) = 3 t^2 - 2 t^3,
/// so that f and its gradient agree on faces that bricks share. It goes through the nodes, and a rigid or affine motion
/// of them moves the points in exactly the same way.
class SmoothRide {
 public:
  /// For these positions of the nodes (m x 3, m); both outlive it.
  SmoothRide(const BrickGrid& grid, const Points& nodes);

  /// n x 3, m.
  [[nodiscard]] Points points(const Embedding& embedding) const;
  /// As deform_normals(): n x 3, not normalised.
  [[nodiscard]] Points normals(const Embedding& embedding, const Points& at_rest) const;

 private:
  struct Place {
    Vec3 position;
    Mat3 gradient;
  };
  [[nodiscard]] Place place(int brick, const Vec3& local) const;

  const BrickGrid& grid_;
  const Points& nodes_;
  std::vector<Mat3> gradients_;  // of the nodes, by metres of the grid
};

}  // namespace sprung
