#pragma once
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/brick_topology.h"

namespace sprung {

/// Points embedded in bricks: each in one brick, by trilinear weights of its eight corners. Points outside their brick
/// are extrapolated: those in the cell of a sliver that their brick has absorbed (absorb_slivers), and those in no cell
/// of the solid at all, which `outside` counts.
struct Embedding {
  std::vector<int> brick;  // n
  Points local;            // n x 3; coordinates in the brick, in [0, 1] if the point is inside
  int outside = 0;
  double furthest = 0;  // largest distance of these from their bricks, in bricks
};

/// The trilinear weights of a brick's eight corners at `local` (in [0, 1]^3 inside); their sum is 1.
[[nodiscard]] CornerWeights trilinear_weights(const Vec3& local);

/// Their derivatives with respect to `local`: 8 x 3.
[[nodiscard]] Eigen::Matrix<double, 8, 3> trilinear_gradients(const Vec3& local);

/// Embeds `points` (grid's frame, m) with outward normals `outward` (n x 3, any length; or 0 rows: unknown). Where a
/// cell has several bricks, a point belongs to that of the nearest solid (BrickGrid::patches); if its normal is known,
/// of the nearest solid on its inward side.
[[nodiscard]] Embedding embed(const BrickGrid& grid, const Points& points, const Points& outward = Points(0, 3));

/// The embedded points for these node positions; n x 3, m. They follow affine motions of the nodes exactly.
[[nodiscard]] Points deform_points(const BrickGrid& grid, const Embedding& embedding, const Points& node_positions);

/// Interpolates nodal values (m) at the embedded points; n. Points outside their brick are clamped to it.
[[nodiscard]] Eigen::VectorXd interpolate(const BrickGrid& grid, const Embedding& embedding,
                                          const Eigen::VectorXd& of_nodes);

/// Rest normals transformed by the inverse transpose of the deformation gradient at each point; n x 3, not normalised.
[[nodiscard]] Points deform_normals(const BrickGrid& grid, const Embedding& embedding, const Points& normals,
                                    const Points& node_positions);

/// Deforms embedded points and normals by a field that is smooth across the faces of the bricks, where trilinear
/// interpolation has creases. Each node has a position and the mean deformation gradient of its bricks; the maps
/// L_k(p) = x_k + F_k (p - X_k) are blended within each brick,
///   f(p) = sum_k w_k(p) L_k(p),   w_k = products of s or 1 - s along the axes,   s(t) = 3 t^2 - 2 t^3,
/// so that f and its gradient are continuous across faces. It interpolates the nodes, and the points follow affine
/// motions of the nodes exactly.
class SmoothEmbedding {
 public:
  /// `nodes`: their positions (m x 3, m). Both must outlive it.
  SmoothEmbedding(const BrickGrid& grid, const Points& nodes);

  /// n x 3, m.
  [[nodiscard]] Points points(const Embedding& embedding) const;
  /// As deform_normals(): n x 3, not normalised.
  [[nodiscard]] Points normals(const Embedding& embedding, const Points& at_rest) const;

 private:
  struct Sample {
    Vec3 position;
    Mat3 gradient;
  };
  [[nodiscard]] Sample sample(int brick, const Vec3& local) const;

  const BrickGrid& grid_;
  const Points& nodes_;
  std::vector<Mat3> gradients_;  // of the nodes
};

}  // namespace sprung
