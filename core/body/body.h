#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/bricks/brick_grid.h"
#include "core/bricks/brick_topology.h"
#include "core/law/brick_law.h"
#include "core/law/material.h"
#include "core/law/solid/curved_solid.h"
#include "core/types.h"

namespace sprung {

struct BrickTiles;

/// Rayleigh damping: a force -alpha m v on every node, and beta times the stiffness times the rate of stretch as a
/// tension along every spring.
struct Rayleigh {
  double alpha = 0;  // 1/s, on the masses; slows rigid motion too
  double beta = 0;   // s, along the springs; does not see rigid motion
};

/// 1/s; an estimate for the slowest vibration of a body of that length: a shear wave crosses it there and back.
[[nodiscard]] double slowest_frequency(const Material& material, double length);

/// The beta that damps it at material.damping of critical.
[[nodiscard]] Rayleigh rayleigh_from_damping(const Material& material, double length);

/// How the solid is distributed in a brick, within the bounds of its law, and how it bends accordingly; full bricks
/// share the latter.
struct BodySolid {
  SolidMoments moments;
  std::shared_ptr<const CurvedSolid> curved;
};

/// One soft body: bricks, their law, and the state of their nodes, in world coordinates.
struct Body {
  BrickGrid grid;
  Model model = Model::kCalibrated;
  Material material;
  BrickLaw law;                            // of a full brick
  Eigen::MatrixXd small_strain_stiffness;  // 24 x 24, N/m, of a full brick: model kFem only, else empty
  Rayleigh damping;
  std::vector<BodySolid> solids;            // per brick: model kCalibrated only, else empty
  std::vector<double> stiffness_scale;      // per brick: its fill, at least kStiffnessFloor
  Eigen::VectorXd masses;                   // per node, kg; sum = density * volume
  Points rest_positions;                    // m x 3, m: the grid's nodes moved to where the body starts
  Points positions;                         // m x 3, m
  Points velocities;                        // m x 3, m/s
  std::shared_ptr<const BrickTiles> tiles;  // how packs of bricks are computed, see build_tiles()

  [[nodiscard]] int node_count() const { return int(positions.rows()); }
};

/// A brick keeps at least this share of a full brick's stiffness and mass: slivers would only shorten the time step.
inline constexpr double kStiffnessFloor = 0.01;

/// A body at rest at the position of its grid. Masses are lumped, fill rho h^3 / 8 per corner (in solid bricks more
/// where their solid lies), and scaled so that their sum is density * grid.volume().
[[nodiscard]] Body make_body(BrickGrid grid, Model model, const Material& material);

/// m, the longest side of its box at rest.
[[nodiscard]] double length_of(const Body& body);

/// Rebuilds the body's tiles; required after a change of its stiffness_scale or its solids. make_body() does this too.
void build_tiles(Body& body);

/// Rotates (then translates) the whole body, rest shape and state; the rotation is about the origin.
void place(Body& body, const Mat3& rotation, const Vec3& translation);

/// Positions of a brick's corners, x y z corner by corner, m.
[[nodiscard]] std::array<double, 24> brick_corners(const Body& body, std::size_t brick);

/// Smallest determinant of any brick's deformation gradient (BrickModel::gradient()); below zero: inverted.
[[nodiscard]] double smallest_volume_ratio(const Body& body);
/// The number of inverted bricks.
[[nodiscard]] int inverted_bricks(const Body& body);

/// A quantity at the eight corners of a brick (positions in m, velocities in m/s), a column each.
using BrickColumns = Eigen::Matrix<double, 3, 8>;

/// `nodes`: of the brick, by corner; `values`: per node of the body, m x 3.
[[nodiscard]] inline BrickColumns columns_of(const std::array<int, 8>& nodes, const Points& values) {
  BrickColumns columns;
  for (int corner = 0; corner < 8; ++corner) {
    columns.col(corner) = values.row(nodes[corner]).transpose();
  }
  return columns;
}

/// The mean axes (columns), each from the brick's low to its high side.
[[nodiscard]] inline Mat3 mean_axes_of(const BrickColumns& x) {
  Mat3 axes = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 8; ++corner) {
      axes.col(axis) += (on_high_side(corner, axis) ? 0.25 : -0.25) * x.col(corner);
    }
  }
  return axes;
}

/// Areas spanned by pairs of the three axes: the gradient of their determinant; this matrix also transforms normals.
[[nodiscard]] inline Mat3 areas_of(const Mat3& axes) {
  Mat3 areas;
  areas << axes.col(1).cross(axes.col(2)), axes.col(2).cross(axes.col(0)), axes.col(0).cross(axes.col(1));
  return areas;
}

/// Sums values at the corners of bricks to their nodes, in the order of the bricks: the same bits for any number of
/// threads. For one body; kept from step to step.
class CornerSums {
 public:
  /// Storage for x y z at each corner, 24 numbers per brick.
  [[nodiscard]] double* room(const BrickGrid& grid);

  /// Writes x y z per node to `sums`.
  void sum(double* sums) const;

 private:
  CornerLists lists_;
  std::vector<double> at_corners_;
};

}  // namespace sprung
