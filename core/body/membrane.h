#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "core/law/rectangle_law.h"
#include "core/types.h"

namespace sprung {

using Vec2 = Eigen::Vector2d;

/// n x 2: one point or vector a row, stored row by row (x y x y ...).
using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A flat body of equal rectangles in the plane, 1 m thick: the 2D body of the experiments.
struct Membrane {
  Material material;
  RectangleLaw law;
  std::vector<std::array<int, 4>> rectangles;  // nodes, corner by corner (see RectangleVector)
  Points2 rest_positions;                      // m x 2, m
  Points2 positions;                           // m x 2, m
  Eigen::VectorXd masses;                      // per node, kg; sum = density * area * 1 m
  std::vector<bool> fixed;                     // 2 m: the degrees of freedom (2 node + axis) that are supported

  [[nodiscard]] int node_count() const { return int(positions.rows()); }
  void fix(int node, int axis) { fixed[2 * std::size_t(node) + axis] = true; }
};

/// A free membrane at rest of the given size (m), low corner at the origin, divided into columns x rows rectangles.
/// Node column + row (columns + 1) is at that column and row. Throws Error(kBadInput) as rectangle_law does.
[[nodiscard]] Membrane make_membrane(int columns, int rows, const Vec2& size, RectangleModel model,
                                     const Material& material);

/// Forces of all springs on the nodes, m x 2, N.
[[nodiscard]] Points2 spring_forces(const Membrane& membrane);

/// Elastic energy, J.
[[nodiscard]] double elastic_energy(const Membrane& membrane);

/// Lower triangle of the second derivative of the elastic energy at membrane.positions, 2 m x 2 m, N/m, supports
/// ignored; with `definite`, each rectangle's without its negative curvature.
[[nodiscard]] Eigen::SparseMatrix<double> stiffness_matrix(const Membrane& membrane, bool definite);

/// A membrane for drawing: its nodes in the plane z = 0 and two triangles per rectangle, facing +z.
struct MembraneSurface {
  Points positions;  // m x 3, m
  Triangles triangles;
};

[[nodiscard]] MembraneSurface membrane_surface(const Membrane& membrane);

}  // namespace sprung
