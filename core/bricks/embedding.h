#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/brick_topology.h"

namespace sprung {

/// Where points ride: each in one brick, by trilinear weights of its eight corners. Outside its brick the weights are
/// continued; `outside` counts such points.
struct Embedding {
  std::vector<int> brick;  // n
  Points local;            // n x 3; place in the brick, 0..1 along each axis where the point is inside
  int outside = 0;
  double furthest = 0;  // distance of those from their bricks at most, in bricks
};

/// The shares of a brick's eight corners in the point at `local` (0..1 along each axis); their sum is 1.
[[nodiscard]] CornerWeights trilinear_weights(const Vec3& local);

/// Their derivatives by the place in the brick: 8 x 3.
[[nodiscard]] Eigen::Matrix<double, 8, 3> trilinear_gradients(const Vec3& local);

/// `points` in the grid's frame, m; `outward` (n x 3, any length; or 0 rows) is where the solid under each ends. Where
/// a cell holds several pieces of solid (BrickGrid::patches) a point rides in the brick of the nearest solid, of that
/// which lies inward of it where `outward` is known.
[[nodiscard]] Embedding embed(const BrickGrid& grid, const Points& points, const Points& outward = Points(0, 3));

/// Where the embedded points are for these node positions; n x 3, m. A rigid or affine motion of the nodes moves them
/// in exactly the same way.
[[nodiscard]] Points deform_points(const BrickGrid& grid, const Embedding& embedding, const Points& node_positions);

/// What the nodes carry (m), mixed at the embedded points; n. Points outside their brick count as on its side.
[[nodiscard]] Eigen::VectorXd interpolate(const BrickGrid& grid, const Embedding& embedding,
                                          const Eigen::VectorXd& of_nodes);

/// Rest normals carried by the inverse transpose of the deformation gradient at each point; n x 3, not normalised.
[[nodiscard]] Points deform_normals(const BrickGrid& grid, const Embedding& embedding, const Points& normals,
                                    const Points& node_positions);

/// Embedded points and normals as they ride on a field that is smooth across the faces of the bricks, where trilinear
/// interpolation has creases. Each node knows where it is and the mean gradient of its bricks there; these linear maps
/// L_k(p) = x_k + F_k (p - X_k) are blended within each brick,
///   f(p) = sum_k w_k(p) L_k(p),   w_k = products of s or 1 - s along the axes,   s(t) = 3 t^2 - 2 t^3,
/// so that f and its gradient agree on faces that bricks share. It goes through the nodes, and a rigid or affine motion
/// of them moves the points in exactly the same way.
class SmoothEmbedding {
 public:
  /// For these positions of the nodes (m x 3, m); both outlive it.
  SmoothEmbedding(const BrickGrid& grid, const Points& nodes);

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
