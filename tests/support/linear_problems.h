#pragma once
#include <gtest/gtest.h>

#include "core/body/brick_model.h"
#include "core/bricks/fill_solid.h"
#include "core/dynamics/linear/linear_solver.h"
#include "core/mesh/io/read_mesh.h"
#include "core/mesh/repair/solids.h"
#include "tests/support/bodies.h"

namespace sprung::test {

/// A bracket with a slot, cut bricks and two materials: everything that a box is not.
inline BrickGrid bracket(int n) {
  BrickGrid grid;
  grid.brick_size = 0.3 / n;
  for (int z = 0; z < n / 3; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const bool is_upright = x < n / 3;
        const bool is_slot = y > n / 6 && x > 1 && z == n / 6;
        if ((y < n / 3 || is_upright) && !is_slot) grid.cells.emplace_back(x - 3, y - 5, z);
      }
    }
  }
  for (const Eigen::Vector3i& cell : grid.cells) grid.fill.push_back(cell.y() == n - 6 ? 0.02 : 1.0);
  number_nodes(grid);
  return grid;
}

/// A model of assets/models with `count` bricks along its longest side.
inline BrickGrid cut_bricks(const std::string& model, int count) {
  const std::string name = SPRUNG_SOURCE_DIR "/assets/models/" + model + ".ply";
  const SurfaceMesh mesh = read_mesh(name);
  const Solid solid = find_solids(mesh, name).solids.at(0);
  const double size = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
  return fill_solid(solid, size / count, bricks_for(Model::kCalibrated)).grid;
}

struct Problem {
  Body body;
  Supports supports;
  StepTerms terms;
  Eigen::VectorXd forces;

  explicit Problem(BrickGrid grid, double poisson = 0.3, Model model = Model::kCalibrated)
      : body(make_body(std::move(grid), model, test_material(poisson, 1e5))), supports(body.node_count()) {
    const int low = body.grid.lattice.front().z();
    for (int node = 0; node < body.node_count(); ++node) {
      if (body.grid.lattice[node].z() == low) supports.fix(node);
    }
    forces = Eigen::VectorXd::Zero(3 * body.node_count());
    for (int node = 0; node < body.node_count(); ++node) forces[3 * node + 1] = -9.81 * body.masses[node];
  }
};

/// Clamped at its left end.
inline Problem cantilever(int n, double poisson) {
  Problem problem(make_box_grid({n, n / 4, n / 4}, 0.4 / n), poisson);
  problem.supports = Supports(problem.body.node_count());
  for (int node = 0; node < problem.body.node_count(); ++node) {
    if (problem.body.grid.lattice[node].x() == 0) problem.supports.fix(node);
  }
  return problem;
}

/// With its nodes moved by up to `amount` bricks, and all terms of a step.
inline Problem shaken_bracket(double poisson, double amount, double mass_factor) {
  std::mt19937 random(4);
  Problem problem(bracket(12), poisson);
  shake(problem.body, amount, random);
  problem.terms.mass_factor = mass_factor;
  problem.terms.damping = 0.7;
  problem.terms.damping_positions = problem.body.rest_positions;
  PointStiffness point{.brick = 40, .weights = CornerWeights::Constant(0.125)};
  point.stiffness = 1e3 * Mat3::Identity();
  problem.terms.points.push_back(point);
  return problem;
}

inline Eigen::VectorXd solve(LinearSolver& system, const Problem& problem, double tolerance, bool definite = false) {
  EXPECT_TRUE(system.linearize(problem.body, problem.supports, definite, problem.terms));
  return system.solve(problem.forces, tolerance);
}

}  // namespace sprung::test
