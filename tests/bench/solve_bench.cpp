// Solves the stiffness of cantilevers under gravity and prints a table: multigrid beside CHOLMOD and conjugate
// gradients with the diagonal, all in one run, so that ratios hold on a busy machine. Options: the bricks along the
// longest sides, and "--direct-up-to N" bricks (default 20 000; beyond, the direct solver takes minutes and gigabytes).
#include <fmt/format.h>

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "core/motion/implicit_motion.h"
#include "core/motion/statics.h"
#include "core/motion/stiffness_matrix.h"

namespace {

using namespace sprung;

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Beam {
  Actor actor;
  Supports supports;
  Points loads;

  /// The paper's cantilever, clamped at x = 0, n bricks long.
  explicit Beam(int n)
      : actor{.body = make_body(
                  make_box_grid({n, n / 4, n / 4}, 0.4 / n), Model::kCalibrated,
                  {.name = "bench", .young = 1000, .poisson = 0.3, .density = 1, .damping = 0.02, .source = ""}),
              .contacts = {},
              .pinned = {}},
        supports(actor.body.node_count()),
        loads(actor.body.masses * Vec3(0, -1, 0).transpose()) {
    for (int node = 0; node < actor.body.node_count(); ++node) {
      if (actor.body.grid.lattice[static_cast<std::size_t>(node)].x() != 0) continue;
      supports.fix(node);
      actor.pinned.push_back({.node = node});
    }
  }
};

double static_solve(int n, NewtonSystem& system) {
  Beam beam(n);
  const Points start = beam.actor.body.positions;
  return seconds([&] { solve_static(beam.actor.body, beam.supports, beam.loads, start, system, {.tolerance = 1e-6}); });
}

/// Linearize and solve once.
double linear_solve(int n, NewtonSystem& system, double tolerance) {
  const Beam beam(n);
  const StepTerms none;
  const Eigen::Map<const Eigen::VectorXd> forces(beam.loads.data(), beam.loads.size());
  return seconds([&] {
    if (!system.linearize(beam.actor.body, beam.supports, false, none) || system.solve(forces, tolerance).size() == 0) {
      std::abort();
    }
  });
}

double diagonal_solve(int n) {
  const Beam beam(n);
  const FreeDofs dofs(beam.supports);
  const Eigen::Map<const Eigen::VectorXd> forces(beam.loads.data(), beam.loads.size());
  return seconds([&] {
    const Eigen::SparseMatrix<double> matrix = stiffness_matrix(beam.actor.body, dofs, false, {});
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower> solver(matrix);
    solver.setTolerance(1e-6);
    if (solver.solve(dofs.gather(forces)).size() == 0) std::abort();
  });
}

/// Of the second of two steps, and how many Newton iterations it took.
std::pair<double, long> implicit_step(int n) {
  Beam beam(n);
  World world;
  world.actors.push_back(std::move(beam.actor));
  world.gravity = {0, -1, 0};
  ImplicitMotion motion(world, {});
  motion.advance(0.01, 1, 0);
  const long before = motion.report().newton_iterations;
  const double time = seconds([&] { motion.advance(0.01, 1, 0.01); });
  return {time, motion.report().newton_iterations - before};
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  int direct_up_to = 20000;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--direct-up-to" && i + 1 < argc) {
      direct_up_to = std::atoi(argv[++i]);
    } else {
      const int size = std::atoi(argv[i]);
      if (size < 4 || size % 4 != 0) {
        fmt::print(stderr, "{}: what is '{}'? Bricks along the longest side: multiples of 4\n", argv[0], argv[i]);
        return 2;
      }
      sizes.push_back(size);
    }
  }
  if (sizes.empty()) sizes = {32, 64, 128};
  fmt::print(
      "| bricks | linear, s | CHOLMOD, s | diagonal CG, s | static to 1e-6, s | CHOLMOD, s | implicit step, s | Newton "
      "iterations |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const int n : sizes) {
    const int bricks = n * (n / 4) * (n / 4);
    const auto multigrid = make_multigrid_system();
    const double linear = linear_solve(n, *multigrid, 1e-6);
    const double still = static_solve(n, *make_multigrid_system());
    const auto [step, iterations] = implicit_step(n);
    const bool has_direct = bricks <= direct_up_to;
    const double direct = has_direct ? linear_solve(n, *make_direct_system(), 0) : 0;
    const double still_direct = has_direct ? static_solve(n, *make_direct_system()) : 0;
    const auto time = [](bool is_there, double value) { return is_there ? fmt::format("{:.3g}", value) : "-"; };
    fmt::print("| {} | {:.3g} | {} | {:.3g} | {:.3g} | {} | {:.3g} | {} |\n", bricks, linear, time(has_direct, direct),
               diagonal_solve(n), still, time(has_direct, still_direct), step, iterations);
    std::fflush(stdout);
  }
}
