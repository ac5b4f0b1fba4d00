#include "core/body/sheet.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "core/error.h"

namespace sprung {
namespace {

RectangleVector corners_of(const Sheet& sheet, const std::array<int, 4>& nodes) {
  RectangleVector x;
  for (Eigen::Index corner = 0; corner < 4; ++corner) {
    x.segment<2>(2 * corner) = sheet.positions.row(nodes[static_cast<std::size_t>(corner)]).transpose();
  }
  return x;
}

RectangleMatrix without_negative_curvature(const RectangleMatrix& hessian) {
  const Eigen::SelfAdjointEigenSolver<RectangleMatrix> solver(hessian);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

Sheet make_sheet(int columns, int rows, const Vec2& size, RectangleModel model, const Material& material) {
  if (columns < 1 || rows < 1) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("a sheet of {} x {} rectangles: it needs one or more", columns, rows));
  }
  Sheet sheet;
  sheet.material = material;
  sheet.law = rectangle_law(model, material, {size.x() / columns, size.y() / rows});
  const int stride = columns + 1;
  const int nodes = stride * (rows + 1);
  sheet.rest_positions.resize(nodes, 2);
  for (int node = 0; node < nodes; ++node) {
    const int row = node / stride;
    sheet.rest_positions.row(node) << size.x() * (node % stride) / columns, size.y() * row / rows;
  }
  sheet.positions = sheet.rest_positions;
  sheet.masses = Eigen::VectorXd::Zero(nodes);
  sheet.fixed.assign(2 * static_cast<std::size_t>(nodes), false);
  const double corner_mass = material.density * size.x() * size.y() / (4.0 * columns * rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int low = column + row * stride;
      sheet.rectangles.push_back({low, low + 1, low + stride, low + stride + 1});
      for (const int node : sheet.rectangles.back()) sheet.masses[node] += corner_mass;
    }
  }
  return sheet;
}

Points2 spring_forces(const Sheet& sheet) {
  Points2 forces = Points2::Zero(sheet.node_count(), 2);
  for (const auto& nodes : sheet.rectangles) {
    const RectangleVector force = rectangle_forces(sheet.law, corners_of(sheet, nodes));
    for (Eigen::Index corner = 0; corner < 4; ++corner) {
      forces.row(nodes[static_cast<std::size_t>(corner)]) += force.segment<2>(2 * corner).transpose();
    }
  }
  return forces;
}

double elastic_energy(const Sheet& sheet) {
  double energy = 0;
  for (const auto& nodes : sheet.rectangles) energy += rectangle_energy(sheet.law, corners_of(sheet, nodes));
  return energy;
}

Eigen::SparseMatrix<double> stiffness_matrix(const Sheet& sheet, bool definite) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * sheet.rectangles.size());
  for (const auto& nodes : sheet.rectangles) {
    RectangleMatrix hessian = rectangle_hessian(sheet.law, corners_of(sheet, nodes));
    if (definite) hessian = without_negative_curvature(hessian);
    for (int b = 0; b < 8; ++b) {
      const int column = 2 * nodes[static_cast<std::size_t>(b / 2)] + b % 2;
      for (int a = 0; a < 8; ++a) {
        const int row = 2 * nodes[static_cast<std::size_t>(a / 2)] + a % 2;
        if (row >= column) entries.emplace_back(row, column, hessian(a, b));
      }
    }
  }
  const int size = 2 * sheet.node_count();
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SheetSurface sheet_surface(const Sheet& sheet) {
  SheetSurface surface;
  surface.positions = Points::Zero(sheet.node_count(), 3);
  surface.positions.leftCols<2>() = sheet.positions;
  surface.triangles.resize(2 * static_cast<Eigen::Index>(sheet.rectangles.size()), 3);
  Eigen::Index triangle = 0;
  for (const auto& nodes : sheet.rectangles) {
    surface.triangles.row(triangle++) << nodes[0], nodes[1], nodes[3];
    surface.triangles.row(triangle++) << nodes[0], nodes[3], nodes[2];
  }
  return surface;
}

}  // namespace sprung
