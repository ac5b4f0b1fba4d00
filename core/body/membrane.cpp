#include "core/body/membrane.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "core/error.h"

namespace sprung {
namespace {

RectangleVector corners_of(const Membrane& membrane, const std::array<int, 4>& nodes) {
  RectangleVector x;
  for (Eigen::Index corner = 0; corner < 4; ++corner) {
    x.segment<2>(2 * corner) = membrane.positions.row(nodes[corner]).transpose();
  }
  return x;
}

RectangleMatrix without_negative_curvature(const RectangleMatrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<RectangleMatrix> solver(hessian);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

Membrane make_membrane(int columns, int rows, const Vec2& size, RectangleModel model, const Material& material) {
  if (columns < 1 || rows < 1) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("a membrane of {} x {} rectangles: it needs one or more", columns, rows));
  }
  Membrane membrane;
  membrane.material = material;
  membrane.law = rectangle_law(model, material, {size.x() / columns, size.y() / rows});
  const int stride = columns + 1;
  const int nodes = stride * (rows + 1);
  membrane.rest_positions.resize(nodes, 2);
  for (int node = 0; node < nodes; ++node) {
    const int row = node / stride;
    membrane.rest_positions.row(node) << size.x() * (node % stride) / columns, size.y() * row / rows;
  }
  membrane.positions = membrane.rest_positions;
  membrane.masses = Eigen::VectorXd::Zero(nodes);
  membrane.fixed.assign(2 * std::size_t(nodes), false);
  const double corner_mass = material.density * size.x() * size.y() / (4.0 * columns * rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int low = column + row * stride;
      membrane.rectangles.push_back({low, low + 1, low + stride, low + stride + 1});
      for (const int node : membrane.rectangles.back()) membrane.masses[node] += corner_mass;
    }
  }
  return membrane;
}

Points2 spring_forces(const Membrane& membrane) {
  Points2 forces = Points2::Zero(membrane.node_count(), 2);
  for (const auto& nodes : membrane.rectangles) {
    const RectangleVector force = rectangle_forces(membrane.law, corners_of(membrane, nodes));
    for (Eigen::Index corner = 0; corner < 4; ++corner) {
      forces.row(nodes[corner]) += force.segment<2>(2 * corner).transpose();
    }
  }
  return forces;
}

double elastic_energy(const Membrane& membrane) {
  double energy = 0;
  for (const auto& nodes : membrane.rectangles) energy += rectangle_energy(membrane.law, corners_of(membrane, nodes));
  return energy;
}

Eigen::SparseMatrix<double> stiffness_matrix(const Membrane& membrane, bool definite) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * membrane.rectangles.size());
  for (const auto& nodes : membrane.rectangles) {
    RectangleMatrix hessian = rectangle_hessian(membrane.law, corners_of(membrane, nodes));
    if (definite) hessian = without_negative_curvature(hessian);
    for (int b = 0; b < 8; ++b) {
      const int column = 2 * nodes[b / 2] + b % 2;
      for (int a = 0; a < 8; ++a) {
        const int row = 2 * nodes[a / 2] + a % 2;
        if (row >= column) entries.emplace_back(row, column, hessian(a, b));
      }
    }
  }
  const int size = 2 * membrane.node_count();
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

MembraneSurface membrane_surface(const Membrane& membrane) {
  MembraneSurface surface;
  surface.positions = Points::Zero(membrane.node_count(), 3);
  surface.positions.leftCols<2>() = membrane.positions;
  surface.triangles.resize(2 * Eigen::Index(membrane.rectangles.size()), 3);
  Eigen::Index triangle = 0;
  for (const auto& nodes : membrane.rectangles) {
    surface.triangles.row(triangle++) << nodes[0], nodes[1], nodes[3];
    surface.triangles.row(triangle++) << nodes[0], nodes[3], nodes[2];
  }
  return surface;
}

}  // namespace sprung
